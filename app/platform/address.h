// A page's address, with the link to the experiment in it. Elsewhere there is none.
#pragma once

#include <string>

namespace tyglab {

/// Up to where a link begins, "https://host/path/"; empty elsewhere.
std::string page_address();
/// Shows a link ("#hanging&k_s=300") in the address bar, where there is one; as a further place that the browser goes
/// back from, or in place of the present one.
void show_in_address(const std::string& link, bool further);

}  // namespace tyglab
