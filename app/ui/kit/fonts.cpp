#include "app/ui/kit/fonts.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>
#include <vector>

#include "app/base/files.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 7> wanted{
    "Inter-Regular.otf",       "Inter-SemiBold.otf", "STIXGeneral-Italic.otf", "JetBrainsMono-Regular.ttf",
    "forkawesome-webfont.ttf", "DejaVuSans.ttf",     "DejaVuSansMono.ttf"};

/// Where Debian puts them, which the search below need not find again. Where there are none they come with the program.
constexpr std::array<const char*, 6> folders{
    "/usr/share/fonts/opentype/inter",          "/usr/share/fonts/opentype/stix",
    "/usr/share/fonts/truetype/jetbrains-mono", "/usr/share/fonts/truetype/fork-awesome",
    "/usr/share/fonts-fork-awesome/fonts",      "/usr/share/fonts/truetype/dejavu"};

using Files = std::map<std::string, fs::path>;

Files find_fonts() {
  Files found;
  std::error_code ignored;
  std::vector<fs::path> known{data_folder() / "fonts"};
  known.insert(known.end(), folders.begin(), folders.end());
  for (const fs::path& folder : known)
    for (const char* name : wanted)
      if (const fs::path file = folder / name; fs::is_regular_file(file, ignored)) found.emplace(name, file);
  if (found.size() == wanted.size()) return found;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it("/usr/share/fonts", options, ignored), end; it != end; it.increment(ignored))
    for (const char* name : wanted)
      if (it->path().filename() == name) found.emplace(name, it->path());
  return found;
}

// What each font may be asked for; every glyph costs time at the start and room in the atlas.
// Text: Latin with Swedish letters, Greek, punctuation, superscripts, arrows, a few signs of mathematics and geometry.
constexpr ImWchar text_glyphs[] = {0x20,   0x17F,  0x370,  0x3FF,  0x1E8A, 0x1E8D, 0x2010, 0x2044, 0x2070, 0x209F,
                                   0x2190, 0x2195, 0x21BA, 0x21BB, 0x2200, 0x2265, 0x25A0, 0x25CF, 0};
/// Numbers, their signs and units, and what may be typed into a field.
constexpr ImWchar number_glyphs[] = {0x20, 0xFF, 0x370, 0x3FF, 0x2010, 0x2044, 0x2070, 0x209F, 0x221E, 0x221E, 0};
/// Superscripts and subscripts: JetBrains Mono has no minus among them.
constexpr ImWchar power_glyphs[] = {0x2070, 0x209F, 0};
constexpr ImWchar symbol_glyphs[] = {0x20, 0x7E, 0x370, 0x3FF, 0x1E8A, 0x1E8D, 0};
/// The program's own words.
constexpr ImWchar plain_glyphs[] = {0x20, 0xFF, 0x2010, 0x2044, 0};

/// The icons, each a range of its own.
const ImWchar* icon_glyphs() {
  static const auto ranges = [] {
    std::array<ImWchar, 2 * std::size(icon::all) + 1> list{};
    for (std::size_t k = 0; k < std::size(icon::all); ++k) {
      const auto* utf8 = reinterpret_cast<const unsigned char*>(icon::all[k]);  // three bytes each
      list[2 * k] = list[2 * k + 1] = ImWchar((utf8[0] & 0x0F) << 12 | (utf8[1] & 0x3F) << 6 | (utf8[2] & 0x3F));
    }
    return list;
  }();
  return ranges.data();
}

class Builder {
 public:
  Builder(float scale, Fonts& fonts) : scale_(scale), fonts_(fonts), files_(find_fonts()) {
    ImGui::GetIO().Fonts->Clear();
  }

  ImFont* load(const char* name, const char* fallback, float size, const ImWchar* glyphs, bool with_icons = false) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const float pixels = std::round(size * scale_);
    ImFontConfig config;
    config.OversampleH = pixels < 24 ? 3 : 1;
    config.OversampleV = 1;
    config.PixelSnapH = false;
    const fs::path* file = choose(name, fallback);
    ImFont* font =
        file != nullptr ? atlas.AddFontFromFileTTF(file->string().c_str(), pixels, &config, glyphs) : nullptr;
    if (font == nullptr) {
      ImFontConfig own;
      own.SizePixels = pixels;
      font = atlas.AddFontDefault(&own);
    }
    if (with_icons) add_icons(pixels);
    return font;
  }

  bool has(const char* name) const { return files_.count(name) != 0; }

  /// Adds to the font that was loaded last the glyphs that it lacks and the other has.
  void complete(const char* name, float size, const ImWchar* glyphs) {
    const auto it = files_.find(name);
    if (it == files_.end()) return;
    ImFontConfig config;
    config.MergeMode = true;
    ImGui::GetIO().Fonts->AddFontFromFileTTF(it->second.string().c_str(), std::round(size * scale_), &config, glyphs);
  }

 private:
  const fs::path* choose(const char* name, const char* fallback) {
    if (const auto it = files_.find(name); it != files_.end()) return &it->second;
    const auto it = files_.find(fallback);
    note(std::string("font ") + name + " not found; using " +
         (it != files_.end() ? fallback : "the built-in font of Dear ImGui"));
    return it != files_.end() ? &it->second : nullptr;
  }
  void add_icons(float pixels) {
    const auto it = files_.find("forkawesome-webfont.ttf");
    if (it == files_.end()) return;
    ImFontConfig config;
    config.MergeMode = true;
    config.GlyphMinAdvanceX = pixels * 1.15f;
    config.GlyphOffset.y = std::round(pixels * 0.04f);
    ImGui::GetIO().Fonts->AddFontFromFileTTF(it->second.string().c_str(), pixels, &config, icon_glyphs());
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

Fonts build_fonts(float scale, float axis) {
  Fonts fonts;
  Builder builder(scale, fonts);
  fonts.text = builder.load("Inter-Regular.otf", "DejaVuSans.ttf", 14, text_glyphs, true);
  fonts.small = builder.load("Inter-Regular.otf", "DejaVuSans.ttf", small_text_at_1, text_glyphs);
  fonts.title = builder.load("Inter-SemiBold.otf", "DejaVuSans.ttf", 14, text_glyphs, true);
  fonts.brand = builder.load("Inter-SemiBold.otf", "DejaVuSans.ttf", 17, plain_glyphs);
  fonts.large_icons = builder.load("Inter-Regular.otf", "DejaVuSans.ttf", 18, plain_glyphs, true);
  fonts.symbol = builder.load("STIXGeneral-Italic.otf", "DejaVuSans.ttf", 19, symbol_glyphs);
  fonts.subscript = builder.load("STIXGeneral-Italic.otf", "DejaVuSans.ttf", 13, symbol_glyphs);
  fonts.axis = axis > fonts.small->FontSize
                   ? builder.load("Inter-Regular.otf", "DejaVuSans.ttf", axis / scale, number_glyphs)
                   : fonts.small;
  fonts.mono = builder.load("JetBrainsMono-Regular.ttf", "DejaVuSansMono.ttf", 13, number_glyphs);
  builder.complete("Inter-Regular.otf", 13, power_glyphs);
  if (!builder.has("forkawesome-webfont.ttf"))
    fonts.notes.push_back(
        "font forkawesome-webfont.ttf not found; buttons show words instead of icons "
        "(install fonts-fork-awesome)");
  return fonts;
}

}  // namespace tyglab
