#include "hdf5_driver.hpp"

#if __has_include(<H5FDdevelop.h>)
#include <H5FDdevelop.h>
#endif
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <new>

namespace corpuscle::hdf5 {
namespace {

int opened = -1;  // H5FDregister takes functions, which get no context

struct DescriptorFile : H5FD_t {
    int descriptor = -1;
    haddr_t end = 0, allocated = 0;
};

H5FD_t* open_descriptor(const char* name, unsigned flags, hid_t, haddr_t) {
    struct stat about{};
    if (std::strcmp(name, the_file) != 0 || (flags & H5F_ACC_RDWR) || ::fstat(opened, &about) != 0) return nullptr;
    auto* file = new (std::nothrow) DescriptorFile{};
    if (!file) return nullptr;
    file->descriptor = opened;
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
        const auto got = ::pread(static_cast<DescriptorFile*>(file)->descriptor, to, size, static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) return std::memset(to, 0, size), 0;  // as HDF5's own driver: a file may end before what it has allocated
        to += got, at += static_cast<haddr_t>(got), size -= static_cast<size_t>(got);
    }
    return 0;
}

herr_t write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, size_t, const void*) { return -1; }

/// Registered once; versions of HDF5 differ in the fields that are not set.
hid_t driver() {
    static const hid_t registered = [] {
        static H5FD_class_t methods{};
#ifdef H5FD_CLASS_VERSION
        methods.version = H5FD_CLASS_VERSION;
        methods.value = 512;  // the first that is free for drivers of others
#endif
        methods.name = "corpuscle descriptor";
        methods.maxaddr = HADDR_MAX >> 1;  // of off_t
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
        for (auto& kind : methods.fl_map) kind = H5FD_MEM_SUPER;
        return H5FDregister(&methods);
    }();
    return registered;
}

}  // namespace

hid_t access_to(int descriptor) {
    opened = descriptor;
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access >= 0 && H5Pset_driver(access, driver(), nullptr) < 0) {
        H5Pclose(access);
        return -1;
    }
    return access;
}

}  // namespace corpuscle::hdf5
