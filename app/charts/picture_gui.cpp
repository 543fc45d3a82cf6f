#include "app/charts/picture_gui.h"

#include "app/panels/imgui_compat.h"
#include "app/viewport/render_target.h"
#include "backends/imgui_impl_opengl3.h"

namespace tyglab {

PictureGui::PictureGui(ImVec2 size, const Theme& theme) : size_(size) {
  IMGUI_CHECKVERSION();
  ImGui::SetCurrentContext(ImGui::CreateContext());
  gui::prepare_io(ImGui::GetIO());
  ImGui::GetIO().DisplaySize = size;
  ImGui::GetIO().DeltaTime = 1;
  fonts_ = build_fonts(theme.scale);
  apply_style(theme);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

PictureGui::~PictureGui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
  ImGui::SetCurrentContext(window_);
}

ImDrawList& PictureGui::draw() const {
  return *ImGui::GetBackgroundDrawList();
}

Image PictureGui::pixels() const {
  constexpr int samples = 4;
  RenderTarget target;
  ImGui::Render();
  target.begin(int(size_.x), int(size_.y), samples);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  target.resolve();
  return target.pixels();
}

}  // namespace tyglab
