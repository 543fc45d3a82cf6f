// The address of the page with the link to the experiment. Other platforms have none.
#pragma once

#include <string>

namespace tyglab {

/// Where a copied link begins, "https://host/path/"; empty elsewhere.
std::string page_address();
/// Shows a link ("#hanging&k_s=300") in the address bar, where there is one, with the lab that is played (empty: none);
/// as a further place that the browser goes back from, or in place of the present one.
void show_in_address(const std::string& link, const std::string& lab, bool further);

}  // namespace tyglab
