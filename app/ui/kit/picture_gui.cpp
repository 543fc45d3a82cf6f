#include "app/ui/kit/picture_gui.h"

#include "app/platform/gl/dialect.h"
#include "app/render/render_target.h"
#include "app/ui/kit/imgui_compat.h"
#include "backends/imgui_impl_opengl3.h"

namespace tyglab {

PictureGui::PictureGui(ImVec2 size, const Theme& theme) : window_(ImGui::GetCurrentContext()), size_(size) {
  IMGUI_CHECKVERSION();
  ImGui::SetCurrentContext(ImGui::CreateContext());
  gui::prepare_io(ImGui::GetIO());
  ImGui::GetIO().DisplaySize = size;
  ImGui::GetIO().DeltaTime = 1;
  fonts_ = build_fonts(theme.scale);
  apply_style(theme);
  ImGui_ImplOpenGL3_Init(shader_version());
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

void PictureGui::show(unsigned texture) const {
  draw().AddImage(gui::texture(texture), {0, 0}, size_, {0, 1}, {1, 0});
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
