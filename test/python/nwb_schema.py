"""Validates NWB files against the published schema with hdmf, a library that others wrote."""

import contextlib
import functools
import os
import warnings

SCHEMA = os.path.join(os.environ.get("CORPUSCLE_DATA") or os.path.join(os.environ["CORPUSCLE_ROOT"], "..", "shared", "data"), "nwb_schema")


def missing():
    """Why files cannot be validated here, or None."""
    if not os.path.isdir(SCHEMA):
        return f"no NWB schema in {SCHEMA}; set CORPUSCLE_DATA"
    try:
        import hdmf  # noqa: F401
    except ImportError:
        return "hdmf is not installed; Debian: python3-hdmf"
    return None


def _spec_class(base):
    """A class of hdmf for specifications whose keys are those of NWB: neurodata_type instead of data_type."""
    class Spec(base):
        type_key = classmethod(lambda cls: "neurodata_type")
        inc_key = classmethod(lambda cls: "neurodata_type_inc")
        def_key = classmethod(lambda cls: "neurodata_type_def")

        @classmethod
        def build_const_args(cls, spec):
            arguments = super().build_const_args(spec)
            for key, own in (("data_type_inc", cls.inc_key()), ("data_type_def", cls.def_key())):
                if own in arguments:
                    arguments[key] = arguments.pop(own)
            return arguments

        @classmethod
        def dataset_spec_cls(cls):
            return _spec_class.dataset

    return Spec


def _catalogue():
    from hdmf.spec import DatasetSpec, GroupSpec, NamespaceCatalog, SpecNamespace

    class NwbNamespace(SpecNamespace):
        types_key = classmethod(lambda cls: "neurodata_types")

    _spec_class.dataset = _spec_class(DatasetSpec)
    return NamespaceCatalog(_spec_class(GroupSpec), _spec_class.dataset, NwbNamespace)


@functools.cache
def _schema():
    """(type map, validators) of the schema."""
    from hdmf.build import TypeMap
    from hdmf.validate import ValidatorMap
    catalogue = _catalogue()
    catalogue.load_namespaces(os.path.join(SCHEMA, "hdmf-common", "namespace.yaml"), resolve=True)
    catalogue.load_namespaces(os.path.join(SCHEMA, "core", "nwb.namespace.yaml"), resolve=True)
    return TypeMap(catalogue), ValidatorMap(catalogue.get_namespace("core"))


@contextlib.contextmanager
def opened(path):
    """The contents of a file, as hdmf reads them."""
    from hdmf.backends.hdf5 import HDF5IO
    from hdmf.build import BuildManager
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        types, _ = _schema()
        with HDF5IO(path, manager=BuildManager(types), mode="r") as file:
            yield file.read_builder()


def errors(path):
    """The errors of the validator, as texts."""
    with opened(path) as builder:
        return [str(error) for error in _schema()[1].validate(builder)]
