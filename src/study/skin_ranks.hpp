#pragma once
// A skin on ranks: each has a range of the afferents of every class and works the force out for itself; rank 0 gathers the spikes, block by
// block, and owns the files.

#include "study/skin_run.hpp"
#include "study/sweep/ranks.hpp"

namespace corpuscle {

/// Rank 0: its own share and all others'. An error of any rank is its own.
std::unique_ptr<SkinAnswerer> leading_answerer(Ranks&, Skin& own, Pool&);
/// Rank 0, at the end, however it came: the others end, too.
void dismiss_skin(Ranks&);
/// Any other rank: answers until the force ends or rank 0 dismisses it.
Result<void> follow_skin(Ranks&, Result<SkinForce*>, Skin*, Pool&);

}  // namespace corpuscle
