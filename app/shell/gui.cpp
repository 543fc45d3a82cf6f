#include "app/shell/sandbox.h"

#include "app/platform/gl/dialect.h"
#include "app/ui/kit/imgui_compat.h"
#include "backends/imgui_impl_opengl3.h"

namespace tyglab {

Gui::Gui(Window& window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  gui::prepare_io(ImGui::GetIO());
  backend_.emplace(window);
  ImGui_ImplOpenGL3_Init(shader_version());
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  backend_.reset();
  ImGui::DestroyContext();
}

void Gui::begin_frame(InputQueue& input, bool bare) {
  ImGui_ImplOpenGL3_NewFrame();
  backend_->begin_frame();
  bare ? input_.hold(input) : input_.feed(input);
  ImGui::NewFrame();
}

void Gui::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Gui::fonts_changed() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  ImGui::GetIO().Fonts->ClearTexData();  // OpenGL has it
}

}  // namespace tyglab
