// corpuscle-hdf5: the helper program that reads and writes HDF5 files.

#include "helper_main.hpp"

int main(int argc, char** argv) {
    using namespace corpuscle;
    return helper_main(argc, argv, "HDF5",
                       {samples_service(open_hdf5_samples), units_service(), trials_service(), tree_service(), writer_service()});
}
