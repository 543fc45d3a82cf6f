#include "tests/monkey/shrink.h"

#include <algorithm>

namespace tyglab::monkey {
namespace {

using Actions = std::vector<Action>;

Actions without(const Actions& actions, std::size_t begin, std::size_t count) {
  Actions rest(actions.begin(), actions.begin() + std::ptrdiff_t(begin));
  rest.insert(rest.end(), actions.begin() + std::ptrdiff_t(std::min(begin + count, actions.size())), actions.end());
  return rest;
}

}  // namespace

Actions shrunk(Actions actions, const std::function<bool(const Actions&)>& fails, const std::function<bool()>& enough) {
  for (std::size_t last = 1; last < actions.size() && !enough(); last *= 2) {
    const Actions end(actions.end() - std::ptrdiff_t(last), actions.end());
    if (!fails(end)) continue;
    actions = end;
    break;
  }
  for (std::size_t piece = std::max<std::size_t>(actions.size() / 2, 1); !enough();) {
    bool shorter = false;
    for (std::size_t begin = 0; begin < actions.size() && actions.size() > 1 && !enough();) {
      Actions rest = without(actions, begin, piece);
      if (!rest.empty() && fails(rest))
        actions = std::move(rest), shorter = true;
      else
        begin += piece;
    }
    if (piece == 1 && !shorter) break;
    piece = std::max<std::size_t>(piece / 2, 1);
  }
  return actions;
}

}  // namespace tyglab::monkey
