#include "io/recording/recording_formats.hpp"

#include "io/sandbox/remote_samples.hpp"

namespace corpuscle {

Result<std::unique_ptr<Table>> open_hdf5_table(const std::string& path, const TableOptions& options) {
    return make_table(open_remote_samples(path, {"corpuscle-hdf5", "the HDF5 library"}, options), path);
}

}  // namespace corpuscle
