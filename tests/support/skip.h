// What a test case does where something that it needs is not there.
#pragma once

#include <string>

namespace tyglab::test {

/// What is not there: something that CI always has, since cmake/packages.txt names it, or something that it may lack
/// too.
enum class Missing { package, of_machine };

/// Prints why this test case cannot run here, and counts it: tests/run takes it from those that passed. Follow it by a
/// return. Where the environment has CI set, a missing package fails the case.
void skip(const std::string& why, Missing what = Missing::package);

}  // namespace tyglab::test
