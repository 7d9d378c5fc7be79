// corpuscle-sound: the helper program that reads sound files.

#include "helper_main.hpp"

int main(int argc, char** argv) {
    using namespace corpuscle;
    return helper_main(argc, argv, "sound", {samples_service(open_sound_samples)});
}
