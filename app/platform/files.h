// The user's files: on a desktop these are files of the system; in a page the browser transfers
// them.
#pragma once

#include <filesystem>
#include <string>

namespace tyglab {

/// Whether files that are written must be handed out, and those to read asked for.
bool files_are_handed_out();
/// Gives a person a file that has been written: the browser downloads it. Elsewhere nothing.
void hand_out(const std::filesystem::path& file);
/// Asks for a file that has one of these endings (".json,.png"); it arrives like one that is dropped on the window.
void ask_for_file(const std::string& endings);
/// Keeps the small files of a folder and those below it for the next session, where the system would forget them.
void keep_files(const std::filesystem::path& folder);

}  // namespace tyglab
