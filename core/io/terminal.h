// Protects the terminal from names, texts and messages of files and drivers, which must not control it.
//
// filter_standard_streams() puts a filter between std::cout, std::cerr and their descriptors, so all printed text
// passes through it, whoever prints it. Outputs that are files ("-") and the progress line have separate streams.
#pragma once

#include <ostream>
#include <string>
#include <string_view>

namespace tyglab {

/// The text with all that a terminal would act on spelled out: control characters but line feed and tab as "\x1b",
/// those above ASCII and marks that turn the direction of writing as "\u202e", bytes that are not UTF-8 as "\x9b".
std::string visible(std::string_view text);

/// The same in one line: line feeds and tabs are spelled out too. For names within a sentence.
std::string in_one_line(std::string_view text);

/// From here on std::cout and std::cerr show text as visible() does, in whatever pieces it comes. Once, before anything
/// is printed.
void filter_standard_streams();

/// Standard output for the content of files: as it is, but visible() where standard output is a terminal.
std::ostream& file_output();

/// Standard error without the filter, for the program's own moves of the cursor. Whatever else goes there has to be
/// visible().
std::ostream& cursor_output();

}  // namespace tyglab
