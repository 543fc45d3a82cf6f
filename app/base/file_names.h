// Makes file names from names that people choose.
#pragma once

#include <string>
#include <string_view>

namespace tyglab {

/// A name in lower-case letters of ASCII and digits, with _ for all between: "Övning å, 2" is "ovning_a_2". Accents and
/// other marks of letters are left out. Empty where nothing remains.
std::string plain_file_name(std::string_view name);

}  // namespace tyglab
