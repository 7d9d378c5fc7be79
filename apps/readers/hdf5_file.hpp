#pragma once
// The part of the HDF5 library that is used here, with handles that close themselves. For the helper program only: damaged files crash
// the library, or keep it busy for ever.

#include <hdf5.h>

#include <optional>
#include <utility>
#include <vector>

#include "io/samples.hpp"

namespace corpuscle::hdf5 {

/// A handle of any kind; below zero: none.
class Id {
    hid_t id_ = -1;
    herr_t (*close_)(hid_t) = nullptr;

public:
    Id() = default;
    Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Id(Id&& o) noexcept : id_(std::exchange(o.id_, -1)), close_(o.close_) {}
    Id& operator=(Id&& o) noexcept { return std::swap(id_, o.id_), std::swap(close_, o.close_), *this; }
    ~Id() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }
};

/// The file in a descriptor; `path` is for messages.
Result<Id> open_file(int descriptor, const std::string& path);

/// A dataset by its path. HDF5 keeps none of its chunks: they are read whole (hdf5_samples.cpp).
Id open_dataset(hid_t file, const std::string& name);

ArrayFacts facts_of(hid_t dataset, std::string name);

/// Every dataset that hard links lead to, in order of their names.
std::vector<ArrayFacts> datasets_in(hid_t file);

/// A member of a compound type that is a number.
struct Member {
    std::string name;
    unsigned index;
};
std::vector<Member> numeric_members(hid_t type);
bool is_number(hid_t type);

// Attributes of a dataset or group: nothing, if there is none of this name and kind.
std::optional<double> number_at(hid_t object, const std::string& attribute);
std::optional<std::string> text_at(hid_t object, const std::string& attribute);
std::vector<std::string> words_at(hid_t object, const std::string& attribute);
std::vector<std::string> attributes_of(hid_t object);

/// The number in a dataset that holds only one.
std::optional<double> single_number(hid_t dataset);

}  // namespace corpuscle::hdf5
