// Messages to the user: in the window, and in the log.
#pragma once

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace tyglab {

struct Message {
  enum class Severity { note, warning, error };
  Severity severity;
  std::string text;
  double born;  ///< s, the window's clock; negative until first shown
};

/// The shown messages, at most three, so that the cloth stays visible: a further one replaces the oldest. A message
/// that is repeated while it is shown is renewed, and enters the log once.
class Messages {
 public:
  static constexpr std::size_t most = 3;

  /// Reserves memory for the list, since memory may be short when a message is due.
  Messages() { list_.reserve(most + 1); }

  void note(std::string text) { add(Message::Severity::note, std::move(text)); }
  void warning(std::string text) { add(Message::Severity::warning, std::move(text)); }
  void error(std::string text) { add(Message::Severity::error, std::move(text)); }

  /// A folder whose name means nothing to the user, such as the page's home: messages name only the files in it.
  std::string unnamed;

  /// Withdraws a message that no longer applies.
  void take_back(const std::string& text) {
    std::erase_if(list_, [&](const Message& m) { return m.text == text; });
  }

  /// Drops expired messages: notes after 4 s, warnings and errors after 8 s. `held`: all count as new, since the user
  /// cannot read them yet.
  void age(double now, bool held = false) {
    for (Message& m : list_)
      if (held) m.born = now;
    std::erase_if(list_, [&](const Message& m) { return m.born >= 0 && now - m.born > lifetime(m.severity); });
  }
  /// Marks a message as seen: its time begins, if it has not yet.
  void show(std::size_t index, double now) {
    if (list_[index].born < 0) list_[index].born = now;
  }
  /// The most important message: the latest of the most severe. There must be one.
  std::size_t foremost() const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < list_.size(); ++k)
      if (list_[k].severity >= list_[best].severity) best = k;
    return best;
  }
  /// The time at which the next message expires, s of the window's clock; at once while none has been shown.
  double next_end() const {
    double end = std::numeric_limits<double>::infinity();
    for (const Message& m : list_)
      if (m.born >= 0) end = std::min(end, m.born + lifetime(m.severity));
    return list_.empty() || std::isfinite(end) ? end : 0;
  }
  void dismiss(std::size_t index) { list_.erase(list_.begin() + std::ptrdiff_t(index)); }
  const std::vector<Message>& list() const { return list_; }

 private:
  static double lifetime(Message::Severity severity) { return severity == Message::Severity::note ? 4 : 8; }
  void add(Message::Severity severity, std::string text) {
    for (std::size_t at = 0; !unnamed.empty() && (at = text.find(unnamed, at)) != std::string::npos;) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      text.erase(at, text.rfind('/', end - 1) + 1 - at);
    }
    const bool shown = std::erase_if(list_, [&](const Message& m) { return m.text == text; }) > 0;
    if (severity != Message::Severity::note && !shown) std::cerr << "tyglab: " + text + '\n';
    list_.push_back({severity, std::move(text), -1});
    if (list_.size() > most) list_.erase(list_.begin());
  }
  std::vector<Message> list_;
};

}  // namespace tyglab
