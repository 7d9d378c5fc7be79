# The code that computes: the equations and the solver. It is optimised; all other code is compiled quickly.
#   list(FILTER sources INCLUDE REGEX "${computing_code}")
set(computing_code "/src/(circuit/(afferent|analysis|batch|device|expression|solve)/|core/|io/(recording|table)/|live/[^/]*.cpp|model/|nir/network|skin/[^/]*.cpp|skin/contact/|skin/wave/)")
