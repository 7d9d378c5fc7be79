#pragma once
// A skin's answer as files, written as it comes.

#include "io/output.hpp"
#include "study/skin_run.hpp"

namespace corpuscle {

/// Writes files that are put in their places at the end.
class SkinWrittenFile : public SkinListener {
public:
    virtual std::vector<std::string> paths() const = 0;
    virtual Result<void> commit() = 0;
};

}  // namespace corpuscle
