#pragma once
// Failure in C: a code and a text for each thread.

#include <limits>
#include <new>
#include <string>
#include <vector>

#include "corpuscle.h"
#include "corpuscle/error.hpp"

namespace corpuscle::api {

/// A call that cannot be carried out: NULL, a destroyed object, a structure of the wrong size.
struct BadCall : std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();  ///< what functions return on failure

/// Stores the failure of this thread. Returns the code. If there is no memory for the text, it is cut.
int set_c_error(int code, const char* text) noexcept;
/// Stores the failure of the exception that is being handled. Returns the code.
int set_c_error_from_exception() noexcept;

/// Returns the result of `work`. If it throws, stores the failure and returns `failed`.
template <class T, class Work>
T or_failed(T failed, const Work& work) noexcept {
    try {
        return work();
    } catch (...) {
        set_c_error_from_exception();
    }
    return failed;
}
/// Runs `work`. Returns CORPUSCLE_OK; if it throws, stores the failure and returns its code.
template <class Work>
int to_code(const Work& work) noexcept {
    try {
        work();
    } catch (...) {
        return set_c_error_from_exception();
    }
    return CORPUSCLE_OK;
}

/// The text of an argument that must be given. Throws BadCall for NULL.
inline std::string required_text(const char* text, const char* argument) {
    if (!text) throw BadCall(std::string(argument) + " is NULL");
    return text;
}

/// The texts of an array. Throws BadCall for NULL.
inline std::vector<std::string> texts_of(const char* const* texts, std::size_t count, const std::string& argument) {
    if (!texts && count > 0) throw BadCall(argument + " is NULL, but its count is not 0");
    std::vector<std::string> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(required_text(texts[k], (argument + "[" + std::to_string(k) + "]").c_str()));
    return out;
}

/// Element k of a list as a C string, or NULL if there are no more, which is not a failure.
inline const char* text_or_null(const std::vector<std::string>& list, std::size_t k) { return k < list.size() ? list[k].c_str() : nullptr; }

}  // namespace corpuscle::api
