#include "app/charts/chart.h"
#include "app/panels/imgui_compat.h"
#include "app/viewport/headless_context.h"
#include "app/viewport/render_target.h"
#include "backends/imgui_impl_opengl3.h"

namespace tyglab {
namespace {

/// Dear ImGui without a window, in the OpenGL context that is current; a window's own comes back after it.
class PictureGui {
 public:
  PictureGui(ImVec2 size, const Theme& theme) {
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
  ~PictureGui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
    ImGui::SetCurrentContext(window_);
  }
  PictureGui(const PictureGui&) = delete;
  PictureGui& operator=(const PictureGui&) = delete;
  const Fonts& fonts() const { return fonts_; }

 private:
  ImGuiContext* window_ = ImGui::GetCurrentContext();  ///< before anything else; null without a window
  Fonts fonts_;
};

}  // namespace

Image picture_of(const std::vector<Chart>& charts, int columns, float scale, float height) {
  Theme theme;
  theme.scale = scale;
  const int across = std::min(columns, std::max(1, int(charts.size())));
  const int down = (int(charts.size()) + across - 1) / across;
  const ImVec2 one{theme.px(chart_width), theme.px(height)};
  const ImVec2 size{one.x * float(across), one.y * float(down)};
  RenderTarget target;
  const PictureGui gui(size, theme);
  const PlotPaint paint{*ImGui::GetBackgroundDrawList(), theme, gui.fonts()};
  paint.draw.AddRectFilled({0, 0}, size, theme.colors.panel);
  for (std::size_t k = 0; k < charts.size(); ++k)
    draw_chart(paint, {one.x * float(int(k) % across), one.y * float(int(k) / across)}, one, charts[k]);
  ImGui::Render();
  target.begin(int(size.x), int(size.y), 4);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  target.resolve();
  return target.pixels();
}

void write_charts(const std::filesystem::path& file, const std::vector<Chart>& charts, int columns, float scale,
                  float height) {
  const HeadlessContext context;
  write_png(file, picture_of(charts, columns, scale, height));
}

}  // namespace tyglab
