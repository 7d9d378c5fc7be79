// The models on SIMD lanes, compiled once for each instruction set, CORPUSCLE_ISA. Only two tables may be visible outside this file: no
// standard container, no model in double, nothing that the linker could share with another file.

#include <array>

#include "model/lanes/fused_kernels.hpp"
#include "model/models.hpp"

namespace corpuscle::lanes {
namespace {

template <class V, class R, class N>
constexpr FusedKernel<V> joined_lanes() {
    if constexpr (can_fuse<R, N>)
        return {none_refractory<N>, flush_decayed_fused<V, R>, fused_tile<V, R, N>};
    else
        return {};
}
template <class V, class R, class Neurons>
struct Joined;
template <class V, class R, template <class> class... N>
struct Joined<V, R, ModelList<N...>> {
    static constexpr FusedKernel<V> with_each[] = {joined_lanes<V, R, N<Batch<V>>>()...};
};

template <class V, class R>
constexpr ReceptorKernel<V> receptor_lanes() {
    return {R::name,
            R::outputs,
            continuous<R>,
            sizeof(R),
            sizeof(typename R::State) / sizeof(Batch<V>),
            build<V, R>,
            start_states<V, R>,
            flush_decayed<V, R>,
            run_receptor_tile<V, R>,
            Joined<V, R, Neurons>::with_each};
}
template <class V, class N>
constexpr NeuronKernel<V> neuron_lanes() {
    return {N::name,
            sizeof(N),
            sizeof(typename N::State) / sizeof(Batch<V>),
            build<V, N>,
            start_states<V, N>,
            flush_decayed<V, N>,
            run_neuron_tile<V, N>};
}

template <class V>
struct All {
    template <template <class> class... R>
    static constexpr auto receptors_of(ModelList<R...>) {
        return std::array<ReceptorKernel<V>, sizeof...(R)>{receptor_lanes<V, R<Batch<V>>>()...};
    }
    template <template <class> class... N>
    static constexpr auto neurons_of(ModelList<N...>) {
        return std::array<NeuronKernel<V>, sizeof...(N)>{neuron_lanes<V, N<Batch<V>>>()...};
    }
    static constexpr auto receptors = receptors_of(Receptors{});
    static constexpr auto neurons = neurons_of(Neurons{});
};

}  // namespace

namespace CORPUSCLE_ISA {
const KernelTable<double> doubles{width<double>, All<double>::receptors, All<double>::neurons};
const KernelTable<float> floats{width<float>, All<float>::receptors, All<float>::neurons};
}  // namespace CORPUSCLE_ISA

}  // namespace corpuscle::lanes
