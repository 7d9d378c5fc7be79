#include "core/force_source.hpp"

namespace corpuscle {

Result<std::vector<double>> read_channel(ForceSource& source) {
    std::vector<double> out;
    for (Frames block(source.channels().size(), 4096);;) {
        TRY(source.read(block));
        if (block.count == 0) return out;
        out.insert(out.end(), block.force[0].begin(), block.force[0].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

}  // namespace corpuscle
