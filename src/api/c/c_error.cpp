// The version, and the last failure of each thread.

#include "api/c/c_error.hpp"

#include "core/version.hpp"

namespace corpuscle::api {
namespace {

struct CError {
    int code = CORPUSCLE_OK;
    std::string text;
};
thread_local CError last_error;

}  // namespace

int set_c_error(int code, const char* text) noexcept {
    last_error.code = code;
    try {
        last_error.text = text;
    } catch (...) {
        last_error.text.clear();
    }
    return code;
}

int set_c_error_from_exception() noexcept {
    try {
        throw;
    } catch (const BadCall& e) {
        return set_c_error(CORPUSCLE_BAD_CALL, e.what());
    } catch (const NotConvergedError& e) {
        return set_c_error(CORPUSCLE_NOT_CONVERGED, e.what());
    } catch (const InterruptedError& e) {
        return set_c_error(CORPUSCLE_STOPPED, e.what());
    } catch (const std::bad_alloc&) {
        return set_c_error(CORPUSCLE_OUT_OF_MEMORY, "not enough memory; use fewer afferents, sites or samples at a time");
    } catch (const std::length_error&) {
        return set_c_error(CORPUSCLE_OUT_OF_MEMORY, "more elements than memory can hold");
    } catch (const std::exception& e) {
        return set_c_error(CORPUSCLE_BAD_INPUT, e.what());
    } catch (...) {
        return set_c_error(CORPUSCLE_BAD_INPUT, "a function of the caller threw an exception");
    }
}

}  // namespace corpuscle::api

int corpuscle_abi() { return CORPUSCLE_ABI; }
const char* corpuscle_version() {
    static_assert(corpuscle::version.data()[corpuscle::version.size()] == '\0');
    return corpuscle::version.data();
}
const char* corpuscle_error() { return corpuscle::api::last_error.text.c_str(); }
int corpuscle_error_code() { return corpuscle::api::last_error.code; }
