#pragma once
// Errors of the public interface. All functions throw them; the texts are those of the command line.

#include <stdexcept>

#include "corpuscle/export.hpp"

namespace corpuscle {

/// Bad input. what() is the message, with file, line and column where they are known.
struct CORPUSCLE_API InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};
/// A circuit has no solution that the solver finds. what() says when, where and which device.
struct CORPUSCLE_API NotConvergedError : InputError {
    using InputError::InputError;
};
/// A progress function asked to stop.
struct CORPUSCLE_API InterruptedError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace corpuscle
