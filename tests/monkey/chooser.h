// Chooses what the monkey does next: of all that a user can do now, rather what has seldom been done.
#pragma once

#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/monkey/action.h"
#include "tests/monkey/player.h"

namespace tyglab::monkey {

class Chooser {
 public:
  /// `one_cloth`: nothing that gives the cloth another number of particles, nor another preset.
  explicit Chooser(unsigned seed, bool one_cloth = false) : random_(seed), one_cloth_(one_cloth) {}

  Action next(Player& player);
  /// How many controls and commands have been used, of those that were seen: a line for people.
  std::string coverage() const;

 private:
  double part() { return double(random_() >> 8) / double(1u << 24); }
  bool one_in(int n) { return below(n) == 0; }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  template <class List>
  const auto& one_of(const List& list) {
    return list[below(std::size(list))];
  }
  std::string seldom(const std::vector<std::string>& names, std::map<std::string, int>& done);
  bool allowed(const std::string& control) const;
  Action control(Player& player);
  Action command(Player& player);
  Action found(Player& player);
  Action on_cloth();
  Action document(Player& player);
  Action stroke();
  std::string value(const std::string& control);
  std::string number_between(double least, double most);
  std::string decimal(double least, double most);

  std::mt19937 random_;
  bool one_cloth_;
  std::map<std::string, int> controls_, commands_, entries_;  ///< seen, and how often used
};

}  // namespace tyglab::monkey
