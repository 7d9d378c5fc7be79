// The models on SIMD lanes. The file is compiled once for each instruction set, CORPUSCLE_ISA. Only the two tables at its end may be
// visible to the linker. It uses no standard container and no model in double: for an inline function that several files contain, the
// linker keeps any one, and if it kept the one from here, a machine without these instructions would crash.

#include <array>

#include "model/lanes/fused_kernels.hpp"
#include "model/models.hpp"

namespace corpuscle::lanes {
namespace {

template <class V, class R, class N>
constexpr FusedKernel<V> fused_kernel() {
    if constexpr (can_fuse<R, N>)
        return {none_refractory<N>, flush_decayed_fused<V, R>, fused_tile<V, R, N>};
    else
        return {};
}
template <class V, class R, class Neurons>
struct FusedKernels;
template <class V, class R, template <class> class... N>
struct FusedKernels<V, R, ModelList<N...>> {
    static constexpr FusedKernel<V> with_each[] = {fused_kernel<V, R, N<Batch<V>>>()...};
};

template <class V, class R>
constexpr ReceptorKernel<V> receptor_kernel() {
    return {R::name,
            R::outputs,
            continuous<R>,
            sizeof(R),
            sizeof(typename R::State) / sizeof(Batch<V>),
            build<V, R>,
            start_states<V, R>,
            flush_decayed<V, R>,
            run_receptor_tile<V, R>,
            FusedKernels<V, R, Neurons>::with_each};
}
template <class V, class N>
constexpr NeuronKernel<V> neuron_kernel() {
    return {N::name,
            sizeof(N),
            sizeof(typename N::State) / sizeof(Batch<V>),
            build<V, N>,
            start_states<V, N>,
            flush_decayed<V, N>,
            run_neuron_tile<V, N>};
}

template <class V>
struct AllKernels {
    template <template <class> class... R>
    static constexpr auto receptors_of(ModelList<R...>) {
        return std::array<ReceptorKernel<V>, sizeof...(R)>{receptor_kernel<V, R<Batch<V>>>()...};
    }
    template <template <class> class... N>
    static constexpr auto neurons_of(ModelList<N...>) {
        return std::array<NeuronKernel<V>, sizeof...(N)>{neuron_kernel<V, N<Batch<V>>>()...};
    }
    static constexpr auto receptors = receptors_of(Receptors{});
    static constexpr auto neurons = neurons_of(Neurons{});
};

}  // namespace

namespace CORPUSCLE_ISA {
const KernelTable<double> kernels_in_double{width<double>, AllKernels<double>::receptors, AllKernels<double>::neurons};
const KernelTable<float> kernels_in_float{width<float>, AllKernels<float>::receptors, AllKernels<float>::neurons};
}  // namespace CORPUSCLE_ISA

}  // namespace corpuscle::lanes
