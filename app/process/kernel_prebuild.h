// Programs for OpenCL devices, built in a process of their own.
//
// The child makes three steps of a small cloth with the preset's constants; the driver, or disk_cache.h, keeps on disk
// what it has built, and the window only loads it.
#pragma once

#include "core/model/preset.h"

namespace tyglab {

/// Has this very program, in another process, make a few steps of a small cloth with that preset's constants on its
/// device, and waits for its end. What a driver builds for it stands on disk then, so that here it is only loaded.
/// Built here, in a thread, it would keep the present cloth waiting: pocl starts no kernel while it builds another.
/// Nothing is prepared where that does not work; whoever needs the program builds it then. `ledger`: of steps that note
/// what bodies stop.
void prepare_programs(const Preset& preset, bool ledger);
/// Has the preset's device build what it would build at the first step and the first look, for a second or more where
/// nothing is kept on disk: here and now. `ledger`: as above. Nothing for other engines; a device that fails says so
/// at the first step.
void run_programs_once(const Preset& preset, bool ledger);

}  // namespace tyglab
