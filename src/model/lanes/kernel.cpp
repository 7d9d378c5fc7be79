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
        return {none_refractory<N>, flush_decayed<V, R, stored_receptor_values<V, R>>, fused_tile<V, R, N>};
    else
        return {};
}
template <class V, class R, template <class> class... N>
constexpr std::array<FusedKernel<V>, sizeof...(N)> fused_kernels(ModelList<N...>) {
    return {fused_kernel<V, R, N<Batch<V>>>()...};
}
template <class V, class R>
constexpr auto fused_with_each = fused_kernels<V, R>(Neurons{});

template <class V, class M, class Call>
constexpr ModelKernel<V, Call> kernel_of(void (*run)(Call&)) {
    return {M::name, sizeof(M), value_count<typename M::State, V>, build<V, M>, start_states<V, M>, flush_decayed<V, M>, run};
}
template <class V, template <class> class... N>
constexpr std::array<NeuronKernel<V>, sizeof...(N)> neuron_kernels(ModelList<N...>) {
    return {kernel_of<V, N<Batch<V>>>(run_neuron_tile<V, N<Batch<V>>>)...};
}
template <class V, class R>
constexpr ReceptorKernel<V> receptor_kernel() {
    constexpr bool scales = requires { R::scales_with_force; };
    return {kernel_of<V, R>(run_receptor_tile<V, R>), R::outputs, continuous<R>, scales, fused_with_each<V, R>};
}
template <class V, template <class> class... R>
constexpr std::array<ReceptorKernel<V>, sizeof...(R)> receptor_kernels(ModelList<R...>) {
    return {receptor_kernel<V, R<Batch<V>>>()...};
}
template <class V>
constexpr auto all_receptors = receptor_kernels<V>(Receptors{});
template <class V>
constexpr auto all_neurons = neuron_kernels<V>(Neurons{});

}  // namespace

namespace CORPUSCLE_ISA {
const KernelTable<double> kernels_in_double{width<double>, all_receptors<double>, all_neurons<double>};
const KernelTable<float> kernels_in_float{width<float>, all_receptors<float>, all_neurons<float>};
}  // namespace CORPUSCLE_ISA

}  // namespace corpuscle::lanes
