#pragma once
// The shared library shows only what is marked with this.
#ifndef CORPUSCLE_API
#define CORPUSCLE_API __attribute__((visibility("default")))
#endif
