// HDF5 file driver that reads or writes the one file that the helper program has open, through its descriptor. Other files, to which an
// HDF5 file may link, cannot be opened.

#include "hdf5_file.hpp"

#if __has_include(<H5FDdevelop.h>)
#include <H5FDdevelop.h>
#endif
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

namespace corpuscle::hdf5 {
namespace {

// Set by descriptor_access(); globals, because HDF5 passes no context to the driver's open function.
int file_descriptor = -1;
bool is_writable = false;
int write_error = 0;  // result of last_write_error()

struct DescriptorFile : H5FD_t {
    int descriptor = -1;
    haddr_t end = 0;        // length of the file, bytes
    haddr_t allocated = 0;  // end of the allocated addresses, as HDF5 sets it
};

H5FD_t* open_descriptor(const char* name, unsigned flags, hid_t, haddr_t) {
    struct stat about{};
    if (std::strcmp(name, only_file_name) != 0 || ((flags & H5F_ACC_RDWR) && !is_writable) || ::fstat(file_descriptor, &about) != 0)
        return nullptr;
    auto* file = new (std::nothrow) DescriptorFile{};
    if (!file) return nullptr;
    file->descriptor = file_descriptor;
    file->end = static_cast<haddr_t>(about.st_size);
    return file;
}

herr_t close_descriptor(H5FD_t* file) { return delete static_cast<DescriptorFile*>(file), 0; }

int compare(const H5FD_t* a, const H5FD_t* b) {
    return static_cast<const DescriptorFile*>(a)->descriptor - static_cast<const DescriptorFile*>(b)->descriptor;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
    if (flags) *flags = H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_METADATA;
    return 0;
}

haddr_t allocated_end(const H5FD_t* file, H5FD_mem_t) { return static_cast<const DescriptorFile*>(file)->allocated; }
herr_t set_allocated_end(H5FD_t* file, H5FD_mem_t, haddr_t end) { return static_cast<DescriptorFile*>(file)->allocated = end, 0; }
haddr_t file_end(const H5FD_t* file, H5FD_mem_t) { return static_cast<const DescriptorFile*>(file)->end; }

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, void* out) {
    auto* to = static_cast<char*>(out);
    while (size > 0) {
        const auto count = ::pread(static_cast<DescriptorFile*>(file)->descriptor, to, size, static_cast<off_t>(at));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return -1;
        if (count == 0) return std::memset(to, 0, size), 0;  // like HDF5's own driver: a file may end before its allocated end
        to += count, at += static_cast<haddr_t>(count), size -= static_cast<size_t>(count);
    }
    return 0;
}

herr_t write(H5FD_t* to, H5FD_mem_t, hid_t, haddr_t at, size_t size, const void* data) {
    if (!is_writable) return -1;
    auto* file = static_cast<DescriptorFile*>(to);
    const auto* from = static_cast<const char*>(data);
    while (size > 0) {
        const auto count = ::pwrite(file->descriptor, from, size, static_cast<off_t>(at));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return write_error = count < 0 ? errno : ENOSPC, -1;
        from += count, at += static_cast<haddr_t>(count), size -= static_cast<size_t>(count);
        file->end = std::max(file->end, at);
    }
    return 0;
}

/// Sets the length of the file to its allocated end. A shorter file would be taken for a truncated one.
herr_t truncate(H5FD_t* to, hid_t, hbool_t) {
    auto* file = static_cast<DescriptorFile*>(to);
    if (!is_writable || file->end == file->allocated) return 0;
    if (::ftruncate(file->descriptor, static_cast<off_t>(file->allocated)) != 0) return write_error = errno, -1;
    return file->end = file->allocated, 0;
}

/// The identifier of the driver, which the first call registers. The fields of H5FD_class_t that are not set here differ between versions
/// of HDF5 and stay 0.
hid_t driver() {
    static const hid_t registered = [] {
        static H5FD_class_t methods{};
#ifdef H5FD_CLASS_VERSION
        methods.version = H5FD_CLASS_VERSION;
        methods.value = 512;  // the first value for third-party drivers
#endif
        methods.name = "corpuscle descriptor";
        methods.maxaddr = HADDR_MAX >> 1;  // the maximum of off_t
        methods.fc_degree = H5F_CLOSE_WEAK;
        methods.open = open_descriptor;
        methods.close = close_descriptor;
        methods.cmp = compare;
        methods.query = query;
        methods.get_eoa = allocated_end;
        methods.set_eoa = set_allocated_end;
        methods.get_eof = file_end;
        methods.read = read;
        methods.write = write;
        methods.truncate = truncate;
        for (auto& kind : methods.fl_map) kind = H5FD_MEM_SUPER;
        return H5FDregister(&methods);
    }();
    return registered;
}

}  // namespace

int last_write_error() { return write_error; }

hid_t descriptor_access(int descriptor, bool writable) {
    file_descriptor = descriptor, is_writable = writable;
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access >= 0 && H5Pset_driver(access, driver(), nullptr) < 0) {
        H5Pclose(access);
        return -1;
    }
    return access;
}

}  // namespace corpuscle::hdf5
