// corpuscle-sound: the helper program that reads sound files.

#include "helper_main.hpp"

int main(int argc, char** argv) { return corpuscle::helper_main(argc, argv, "sound", corpuscle::open_sound_samples); }
