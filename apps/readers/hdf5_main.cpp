// corpuscle-hdf5: the helper program that reads HDF5 files.

#include "helper_main.hpp"

int main(int argc, char** argv) { return corpuscle::helper_main(argc, argv, "HDF5", corpuscle::open_hdf5_samples); }
