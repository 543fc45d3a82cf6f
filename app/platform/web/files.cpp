#include "app/platform/files.h"

#include "app/platform/address.h"

// Of app/platform/web/library.js.
extern "C" {
void tyglab_hand_out(const char* file);
void tyglab_ask_for_file(const char* endings);
void tyglab_keep_files(const char* folder);
int tyglab_page_address(char* text, int bytes);
void tyglab_show_in_address(const char* link, const char* lab, int further);
}

namespace tyglab {

bool files_are_handed_out() {
  return true;
}

void hand_out(const std::filesystem::path& file) {
  tyglab_hand_out(file.c_str());
}

void ask_for_file(const std::string& endings) {
  tyglab_ask_for_file(endings.c_str());
}

void keep_files(const std::filesystem::path& folder) {
  tyglab_keep_files(folder.c_str());
}

std::string page_address() {
  constexpr int most = 4096;
  std::string text(most, '\0');
  text.resize(std::size_t(tyglab_page_address(text.data(), most)));
  return text;
}

void show_in_address(const std::string& link, const std::string& lab, bool further) {
  tyglab_show_in_address(link.c_str(), lab.c_str(), further ? 1 : 0);
}

}  // namespace tyglab
