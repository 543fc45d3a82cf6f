#include "app/studies/studies.h"

namespace tyglab {

Wants& Wants::operator|=(const Wants& other) {
  for (const auto want :
       {&Wants::stability, &Wants::accuracy, &Wants::convergence, &Wants::settings, &Wants::settings_kept, &Wants::map,
        &Wants::ledger, &Wants::step, &Wants::forces, &Wants::height, &Wants::copies})
    this->*want |= other.*want;
  return *this;
}

void Studies::update(const Wants& wants, StudyMoment& moment) {
  if (wants.stability) stability.poll(moment);
  wants.accuracy ? accuracy.poll(moment) : accuracy.drop();
  wants.convergence ? convergence.poll(moment) : convergence.drop();
  if (wants.settings)
    settings.poll(moment);
  else if (!wants.settings_kept)
    settings.drop();
  wants.map ? map.poll(moment) : map.drop();
}

}  // namespace tyglab
