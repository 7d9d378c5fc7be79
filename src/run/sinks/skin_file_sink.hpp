#pragma once
// Output files of a skin run, written block by block.

#include "io/output/output_file.hpp"
#include "run/skin/skin_run.hpp"

namespace corpuscle {

/// A sink that writes files. The files get their final names in commit().
class SkinFileSink : public SkinSink {
public:
    virtual std::vector<std::string> paths() const = 0;
    virtual Result<void> commit() = 0;
};

}  // namespace corpuscle
