#pragma once
// Turns frames of taxels into the force at the sites of a skin: for recordings, live frames and the library alike.

#include "skin/taxel/taxel_map.hpp"
#include "skin/taxel/taxel_texture.hpp"

namespace corpuscle {

class TaxelFrames {
    /// How the forces along the axes of a taxel act on the skin.
    struct Axes {
        double x[2], y[2];  // shear of the skin along x and y for each N along the x and y axis of the taxel
        double normal;      // normal force for each N along its z axis
    };
    TaxelMap map_;
    std::vector<Axes> axes_;                          // of each taxel; empty: a frame has normal forces only
    std::vector<double> normal_, along_x_, along_y_;  // of the taxels in the last frame, N
    std::unique_ptr<TaxelTexture> texture_;           // null: none

    void add_texture(double* normal, double* shear_x, double* shear_y, std::size_t stride);

public:
    TaxelFrames() = default;
    /// `map`: of this layout. `has_shear`: a frame has three forces for each taxel, along its x, y and z axis; otherwise one, the normal
    /// force.
    TaxelFrames(const TaxelLayout&, TaxelMap map, bool has_shear);

    /// From now on, the force at each site is multiplied by the factor of the texture. Null: none.
    void set_texture(std::unique_ptr<TaxelTexture> texture) { texture_ = std::move(texture); }

    std::size_t frame_size() const { return map_.taxel_count * (has_shear() ? 3 : 1); }  ///< number of forces; 0: default constructed
    bool has_shear() const { return !axes_.empty(); }
    const TaxelMap& map() const { return map_; }
    /// Overwrites the force at the sites of the map; element site * stride of each array. Without shear, the last two may be null. Returns
    /// the total normal force of the frame, N, without the texture.
    double spread(const double* frame, double* normal, double* shear_x, double* shear_y, std::size_t stride = 1);
};

}  // namespace corpuscle
