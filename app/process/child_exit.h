// How a part of the program that ran separately ended.
#pragma once

#include <string>

namespace tyglab {

/// How a child process ended.
struct ChildExit {
  std::string result;      ///< of its function; empty unless it returned and all of the result arrived
  int code = 0;            ///< exit code: 0 unless the function threw or the result could not be sent
  int signal = 0;          ///< that ended it; 0: none
  bool timed_out = false;  ///< it was killed for taking too long
  double seconds = 0;      ///< from its start to its end
};

/// "Segmentation fault": a signal in words; on Windows an exception by its number.
std::string signal_words(int signal);

}  // namespace tyglab
