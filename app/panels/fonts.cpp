#include "app/panels/fonts.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>

namespace tyglab {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 7> wanted{
    "Inter-Regular.otf",       "Inter-SemiBold.otf", "STIXGeneral-Italic.otf", "JetBrainsMono-Regular.ttf",
    "forkawesome-webfont.ttf", "DejaVuSans.ttf",     "DejaVuSansMono.ttf"};

/// Where Debian puts them, which the search below need not find again.
constexpr std::array<const char*, 6> folders{
    "/usr/share/fonts/opentype/inter",          "/usr/share/fonts/opentype/stix",
    "/usr/share/fonts/truetype/jetbrains-mono", "/usr/share/fonts/truetype/fork-awesome",
    "/usr/share/fonts-fork-awesome/fonts",      "/usr/share/fonts/truetype/dejavu"};

using Files = std::map<std::string, fs::path>;

Files find_fonts() {
  Files found;
  std::error_code ignored;
  for (const char* folder : folders)
    for (const char* name : wanted)
      if (const fs::path file = fs::path(folder) / name; fs::is_regular_file(file, ignored)) found.emplace(name, file);
  if (found.size() == wanted.size()) return found;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it("/usr/share/fonts", options, ignored), end; it != end; it.increment(ignored))
    for (const char* name : wanted)
      if (it->path().filename() == name) found.emplace(name, it->path());
  return found;
}

// Latin with Swedish letters, Greek, punctuation, superscripts, arrows, a few signs of mathematics and geometry.
constexpr std::array<ImWchar, 21> text_glyphs{0x20,   0x17F,  0x370,  0x3FF,  0x1E8A, 0x1E8D, 0x2010,
                                              0x2044, 0x2070, 0x209F, 0x2190, 0x2195, 0x21BA, 0x21BB,
                                              0x2200, 0x2265, 0x25A0, 0x25CF, 0,      0,      0};
constexpr std::array<ImWchar, 3> icon_glyphs{0xF000, 0xF2FF, 0};

class Builder {
 public:
  Builder(float scale, Fonts& fonts) : scale_(scale), fonts_(fonts), files_(find_fonts()) {
    ImGui::GetIO().Fonts->Clear();
  }

  ImFont* load(const char* name, const char* fallback, float size, bool with_icons = false) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const float pixels = std::round(size * scale_);
    ImFontConfig config;
    config.OversampleH = pixels < 24 ? 3 : 1;
    config.OversampleV = 1;
    config.PixelSnapH = false;
    const fs::path* file = choose(name, fallback);
    ImFont* font =
        file != nullptr ? atlas.AddFontFromFileTTF(file->c_str(), pixels, &config, text_glyphs.data()) : nullptr;
    if (font == nullptr) {
      ImFontConfig own;
      own.SizePixels = pixels;
      font = atlas.AddFontDefault(&own);
    }
    if (with_icons) add_icons(pixels);
    return font;
  }

  bool has(const char* name) const { return files_.count(name) != 0; }

 private:
  const fs::path* choose(const char* name, const char* fallback) {
    if (const auto it = files_.find(name); it != files_.end()) return &it->second;
    const auto it = files_.find(fallback);
    note(std::string("font ") + name + " not found; using " + (it != files_.end() ? fallback : "Dear ImGui's own"));
    return it != files_.end() ? &it->second : nullptr;
  }
  void add_icons(float pixels) {
    const auto it = files_.find("forkawesome-webfont.ttf");
    if (it == files_.end()) return;
    ImFontConfig config;
    config.MergeMode = true;
    config.GlyphMinAdvanceX = pixels * 1.15f;
    config.GlyphOffset.y = std::round(pixels * 0.04f);
    ImGui::GetIO().Fonts->AddFontFromFileTTF(it->second.c_str(), pixels, &config, icon_glyphs.data());
    fonts_.icons = true;
  }
  void note(std::string text) {
    for (const std::string& old : fonts_.notes)
      if (old == text) return;
    fonts_.notes.push_back(std::move(text));
  }

  float scale_;
  Fonts& fonts_;
  Files files_;
};

}  // namespace

Fonts build_fonts(float scale) {
  Fonts fonts;
  Builder builder(scale, fonts);
  fonts.text = builder.load("Inter-Regular.otf", "DejaVuSans.ttf", 14, true);
  fonts.small = builder.load("Inter-Regular.otf", "DejaVuSans.ttf", 12);
  fonts.title = builder.load("Inter-SemiBold.otf", "DejaVuSans.ttf", 14, true);
  fonts.brand = builder.load("Inter-SemiBold.otf", "DejaVuSans.ttf", 17);
  fonts.large_icons = builder.load("Inter-Regular.otf", "DejaVuSans.ttf", 18, true);
  fonts.huge = builder.load("Inter-SemiBold.otf", "DejaVuSans.ttf", 40);
  fonts.symbol = builder.load("STIXGeneral-Italic.otf", "DejaVuSans.ttf", 19);
  fonts.subscript = builder.load("STIXGeneral-Italic.otf", "DejaVuSans.ttf", 13);
  fonts.mono = builder.load("JetBrainsMono-Regular.ttf", "DejaVuSansMono.ttf", 13);
  if (!builder.has("forkawesome-webfont.ttf"))
    fonts.notes.push_back(
        "font forkawesome-webfont.ttf not found; buttons carry words in place of icons "
        "(install fonts-fork-awesome)");
  return fonts;
}

}  // namespace tyglab
