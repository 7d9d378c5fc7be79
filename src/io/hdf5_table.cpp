#include "io/hdf5_table.hpp"

#include "io/bytes.hpp"
#include "io/hdf5_samples.hpp"
#include "io/remote_samples.hpp"

namespace corpuscle {

Result<std::unique_ptr<Table>> open_hdf5_table(const std::string& path, const TableOptions& options) {
    if (auto file = open_bytes(path); !file) return file.error();
    return table_of(in_helper_process(path, "the HDF5 library", [&] { return open_hdf5_samples(path, options.dataset); }), path);
}

}  // namespace corpuscle
