
#include "app/ui/kit/scene_picture.h"

#include "app/platform/gl/dialect.h"
#include "app/platform/platform.h"
#include "app/render/render_target.h"
#include "app/ui/kit/chart.h"
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

Image picture_of(const std::vector<Chart>& charts, int columns, float scale, float height) {
  Theme theme;
  theme.scale = scale;
  const int across = std::min(columns, std::max(1, int(charts.size())));
  const int down = (int(charts.size()) + across - 1) / across;
  const ImVec2 one{theme.px(chart_width), theme.px(height)};
  const ImVec2 size{one.x * float(across), one.y * float(down)};
  const PictureGui gui(size, theme);
  const PlotPaint paint{gui.draw(), theme, gui.fonts()};
  paint.draw.AddRectFilled({0, 0}, size, theme.colors.panel);
  for (std::size_t k = 0; k < charts.size(); ++k)
    draw_chart(paint, {one.x * float(int(k) % across), one.y * float(int(k) / across)}, one, charts[k]);
  return gui.pixels();
}

void write_charts(const std::filesystem::path& file, const std::vector<Chart>& charts, Reach reach, int columns,
                  float scale, float height) {
  const HeadlessContext context;
  write_png(file, picture_of(charts, columns, scale, height), reach);
}

}  // namespace tyglab
