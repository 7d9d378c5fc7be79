#pragma once
// The functions of the HDF5 library that the reader uses, with handles that close themselves. For the helper program only, because damaged
// files can crash the library or make it loop forever.

#include <hdf5.h>

#include "io/recording/samples.hpp"

namespace corpuscle::hdf5 {

/// An HDF5 identifier, closed by the destructor. A negative identifier, which is the result of a failed call, means none.
class Handle {
    hid_t id_ = -1;
    herr_t (*close_)(hid_t) = nullptr;

public:
    Handle() = default;
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Handle(Handle&& o) noexcept : id_(std::exchange(o.id_, -1)), close_(o.close_) {}
    Handle& operator=(Handle&& o) noexcept { return std::swap(id_, o.id_), std::swap(close_, o.close_), *this; }
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }
};

inline constexpr const char* only_file_name = "file";  ///< the only name that H5Fopen accepts with descriptor_access()
/// A file access property list with which H5Fopen reads `descriptor`, or H5Fcreate writes it if it is `writable`; negative on failure. The
/// caller closes the list. Only one descriptor can be used at a time.
hid_t descriptor_access(int descriptor, bool writable = false);
/// errno of the last write to the descriptor that failed; 0: none has failed.
int last_write_error();

/// Opens the HDF5 file that is open as `descriptor`; `path` is for messages.
Result<Handle> open_file(int descriptor, const std::string& path);

/// Opens a dataset by its path in the file; an empty handle on failure. The chunk cache of HDF5 is disabled, because hdf5_samples.cpp reads
/// complete chunks.
Handle open_dataset(hid_t file, const std::string& name);

/// The shape of a dataset, and whether it has numbers. `name` is copied into the result.
ArrayInfo array_info(hid_t dataset, std::string name);

/// All datasets that are reachable by hard links, ordered by name.
std::vector<ArrayInfo> datasets_in(hid_t file);

/// The datasets of a group and of its groups down to `depth` levels, in the order of the names, also those behind soft links; at most
/// `limit`. "": the root. Links of the name `skipped` are left out.
std::vector<ArrayInfo> datasets_below(hid_t file, const std::string& group, int depth, std::size_t limit, const std::string& skipped = "");

/// A numeric member of a compound type.
struct CompoundMember {
    std::string name;
    unsigned index;  ///< among all members of the type, from 0
};
/// The integer and floating-point members of a compound type; empty for other types and for complex numbers.
std::vector<CompoundMember> numeric_members(hid_t type);
bool is_number(hid_t type);  ///< true for integer and floating-point types

// The value of an attribute of a dataset or group; empty if it has no attribute of this name and type. number_attribute() and
// text_attribute() need an attribute with a single element.
std::optional<double> number_attribute(hid_t object, const std::string& attribute);
std::optional<std::string> text_attribute(hid_t object, const std::string& attribute);
std::vector<std::string> string_attributes(hid_t object, const std::string& attribute);
/// The names of all attributes of a dataset or group.
std::vector<std::string> attribute_names(hid_t object);

/// The strings in a dataset; empty if it has other values, or on failure.
std::vector<std::string> strings_in(hid_t dataset);

/// The number in a dataset that contains exactly one; otherwise nullopt.
std::optional<double> single_number(hid_t dataset);

/// How the data of a dataset are stored.
struct StorageInfo {
    std::vector<hsize_t> chunk = {};      ///< elements of a chunk in each dimension of the dataset; empty if the dataset is not chunked
    bool has_gaps = false;                ///< true if some chunks were never written and have no fill value defined by the file's author
    std::vector<std::string> notes = {};  ///< for the user
};

/// Checks that the data of a dataset exist. HDF5 reads data that were never written, or that are in missing files, as the fill value, which
/// is 0 by default. Fails if the data are in other files, if less than half of them were written, if a chunk is too large, or if a filter
/// is not available.
Result<StorageInfo> check_storage(hid_t dataset, const ArrayInfo&, const std::string& path);

/// True if the chunk that begins at element `offset` (an index in each dimension) was written.
bool is_chunk_written(hid_t dataset, std::span<const hsize_t> offset);

}  // namespace corpuscle::hdf5
