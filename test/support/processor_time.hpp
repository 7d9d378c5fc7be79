#pragma once
// Tests of algorithms whose time must not grow out of proportion. Processor time, unlike that of a clock, does not depend on other
// processes.

#include <ctime>

namespace corpuscle::test {

/// The processor time (s) of a call, in all threads.
template <class Call>
double processor_time(const Call& call) {
    const auto begin = std::clock();
    call();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace corpuscle::test
