// The running program, as the system identifies it.
#pragma once

#include <filesystem>
#include <string>

namespace tyglab {

/// Its file. Throws std::filesystem::filesystem_error where the system does not say.
std::filesystem::path program_file();
/// What starts this very program once more, even where its file has been replaced since.
std::string this_program_again();
/// Where the files that come with it are, when it is in that folder.
std::filesystem::path data_folder_beside(const std::filesystem::path& folder);
/// How long it has run, s.
double program_age_s();

}  // namespace tyglab
