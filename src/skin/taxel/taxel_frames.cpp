#include "skin/taxel/taxel_frames.hpp"

#include "core/number/elementary.hpp"

namespace corpuscle {

TaxelFrames::TaxelFrames(const TaxelLayout& layout, TaxelMap map, bool has_shear)
    : map_(std::move(map)), normal_(map_.taxel_count), along_x_(map_.taxel_count), along_y_(map_.taxel_count) {
    if (!has_shear) return;
    for (const auto& taxel : layout.taxels) {
        const double c = num::cos_turns(taxel.pose.rotation), s = num::sin_turns(taxel.pose.rotation);
        const auto &x = taxel.axes.x, &y = taxel.axes.y;
        axes_.push_back({{c * x[0] - s * y[0], c * x[1] - s * y[1]}, {s * x[0] + c * y[0], s * x[1] + c * y[1]}, taxel.axes.normal});
    }
}

double TaxelFrames::spread(const double* frame, double* normal, double* shear_x, double* shear_y, std::size_t stride) {
    double total = 0;
    for (std::size_t k = 0; k < map_.taxel_count; ++k) {
        normal_[k] = has_shear() ? axes_[k].normal * frame[3 * k + 2] : frame[k];
        total += map_.total[k] * normal_[k];
        if (!has_shear()) continue;
        const double x = frame[3 * k], y = frame[3 * k + 1];
        along_x_[k] = axes_[k].x[0] * x + axes_[k].x[1] * y, along_y_[k] = axes_[k].y[0] * x + axes_[k].y[1] * y;
    }
    map_.spread(normal_.data(), normal, stride);
    if (has_shear()) map_.spread(along_x_.data(), shear_x, stride), map_.spread(along_y_.data(), shear_y, stride);
    if (texture_) add_texture(normal, shear_x, shear_y, stride);
    return total;
}

void TaxelFrames::add_texture(double* normal, double* shear_x, double* shear_y, std::size_t stride) {
    texture_->next();
    for (const auto site : map_.sites) {
        const double factor = texture_->factor(site);
        normal[site * stride] *= factor;
        if (has_shear()) shear_x[site * stride] *= factor, shear_y[site * stride] *= factor;
    }
}

}  // namespace corpuscle
