// The positions of the controls in a frame, by name.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "app/ui/kit/ui_context.h"

namespace tyglab {

class ControlPlaces : public ControlLog {
 public:
  /// Controls that cannot be seen are left out.
  void add_control(std::string_view name) override;
  /// What has been added is what is shown from now on.
  void end_frame();
  /// Of the last whole frame, as much of each as is seen; pixels in the window.
  const std::map<std::string, Box>& shown() const { return shown_; }

 private:
  std::map<std::string, Box> drawing_, shown_;
};

}  // namespace tyglab
