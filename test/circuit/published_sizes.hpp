#pragma once
// The array sizes published in the thesis (tables 1 to 9, 16, 19, 20), including misprints. For each size, the devices of the netlists in
// circuits/ that have it. Also the sizes in these netlists that differ from the published ones, with the erratum that gives the reason
// (sections errata-... of reproduction/reproduction.md).

namespace corpuscle::circuit {

/// A row of a published table: m columns of n elements of W by L (um), and the devices of this size. Device paths are relative to the
/// table's TableLocation::path.
struct PublishedSize {
    const char* table;
    const char* name;
    int m, n;
    double W, L;
    const char* devices;
};

// Reasons for names of devices that differ from the printed ones. Table 1's second M1 is a misprint of M3 (errata F9). Table 2's M4A-E and
// M5A-E are misprints of M4A-B and M5A-B (errata F10). Table 9's M3B and M3C are named as in table 6, where they are M3C and M3B. Table 4's
// M3 is two devices, both sides of a mirror.
inline constexpr PublishedSize published_sizes[] = {
    {"1", "M1", 4, 4, 1.5, 0.5, "mn1"},
    {"1", "M1 (second)", 8, 1, 1.5, 0.5, "mn3"},
    {"1", "M2", 16, 1, 1.5, 0.5, "mn2"},

    {"2", "M1A-E", 4, 4, 6.0, 0.5, "mp1a mp1b mp1c mp1d mp1e"},
    {"2", "M1F", 8, 1, 6.0, 0.5, "mp1f"},
    {"2", "M2A-E", 16, 1, 6.0, 0.5, "mp2a mp2b mp2c mp2d mp2e"},
    {"2", "M2F", 8, 1, 6.0, 0.5, "mp2f"},
    {"2", "M3A-B", 16, 1, 1.5, 0.5, "mp3a mp3b"},
    {"2", "M3C-D", 16, 1, 6.0, 0.5, "mp3c mp3d"},
    {"2", "M4A-E", 4, 4, 1.5, 0.5, "mn4a mn4b"},
    {"2", "M4C", 8, 1, 1.5, 0.5, "mn4c"},
    {"2", "M5A-E", 16, 1, 1.5, 0.5, "mn5a mn5b"},
    {"2", "M5C", 8, 1, 1.5, 0.5, "mn5c"},

    {"3", "M1A-C", 2, 8, 6.0, 0.5, "xload.mp1a xload.mp1b xload.mp1c"},
    {"3", "M2A-C", 2, 8, 1.5, 0.5, "xload.mn2a xload.mn2b xload.mn2c"},
    {"3", "M3A", 8, 2, 6.0, 0.5, "mp3a"},
    {"3", "M3B", 4, 2, 6.0, 0.5, "mp3b"},
    {"3", "M3C", 4, 2, 6.0, 0.5, "mp3c"},
    {"3", "M4A,B", 2, 4, 6.0, 0.5, "mn4a mn4b"},

    {"4", "M1A-B", 2, 8, 6.0, 0.5, "mp1a mp1b"},
    {"4", "M2A-B", 2, 8, 1.5, 0.5, "mn2a mn2b"},
    {"4", "M3", 16, 2, 6.0, 0.5, "mp3a mp3b"},
    {"4", "M4A-C", 8, 4, 6.0, 0.5, "mn4a mn4b mn4c"},
    {"4", "M5A-C", 16, 2, 6.0, 0.5, "mp5a mp5c"},

    {"5", "M1A-C", 2, 8, 6.0, 0.5, "xb.mp1a xb.mp1b xb.mp1c"},
    {"5", "M2A-C", 2, 8, 1.5, 0.5, "xb.mn2a xb.mn2b xb.mn2c"},
    {"5", "M3A,C", 8, 1, 6.0, 0.5, "mp3a mp3c"},
    {"5", "M3B,D", 2, 4, 6.0, 0.5, "mp3b mp3d"},
    {"5", "M4A,C", 8, 1, 1.5, 0.5, "mn4a mn4c"},
    {"5", "M4B,D", 2, 4, 1.5, 0.5, "mn4b mn4d"},
    {"5", "M5A", 16, 1, 6.0, 0.5, "mp5a"},
    {"5", "M5B", 2, 8, 6.0, 0.5, "mp5b"},
    {"5", "M6A", 8, 2, 1.5, 0.5, "mn6a"},
    {"5", "M6B", 2, 4, 1.5, 0.5, "mn6b"},

    {"6", "M1A", 4, 2, 6.0, 0.5, "xrectb.mp1a xrectc.mp1a"},
    {"6", "M1B", 4, 2, 6.0, 0.5, "xrectb.mp1b xrectc.mp1b"},
    {"6", "M2A (I_B)", 16, 8, 1.5, 0.5, "xrectb.mn2a"},
    {"6", "M2B (I_B)", 16, 8, 1.5, 0.5, "xrectb.mn2b"},
    {"6", "M2A (I_C)", 2, 8, 1.5, 0.5, "xrectc.mn2a"},
    {"6", "M2B (I_C)", 2, 8, 1.5, 0.5, "xrectc.mn2b"},
    {"6", "M3A", 16, 1, 6.0, 0.5, "xrectb.xtrigger.mp3a xrectc.xtrigger.mp3a"},
    {"6", "M3B", 8, 1, 6.0, 0.5, "xrectb.xtrigger.mp3b xrectc.xtrigger.mp3b"},
    {"6", "M3C", 2, 4, 6.0, 0.5, "xrectb.xtrigger.mp3c xrectc.xtrigger.mp3c"},
    {"6", "M3D", 2, 1, 6.0, 0.5, "xrectb.mp3d xrectc.mp3d"},
    {"6", "M4A", 16, 1, 1.5, 0.5, "xrectb.xtrigger.mn4a xrectc.xtrigger.mn4a"},
    {"6", "M4B", 8, 1, 1.5, 0.5, "xrectb.xtrigger.mn4b xrectc.xtrigger.mn4b"},
    {"6", "M4C", 2, 4, 1.5, 0.5, "xrectb.xtrigger.mn4c xrectc.xtrigger.mn4c"},
    {"6", "M4D", 2, 1, 1.5, 0.5, "xrectb.mn4d xrectc.mn4d"},
    {"6", "M5A", 2, 1, 6.0, 0.5, "xrectb.mp5a xrectc.mp5a"},
    {"6", "M6A", 2, 1, 1.5, 0.5, "xrectb.mn6a xrectc.mn6a"},

    {"7", "M1A,C", 8, 1, 1.0, 0.5, "mn1a mn1c"},
    {"7", "M1B,D", 2, 4, 1.0, 0.5, "mn1b mn1d"},
    {"7", "M2A", 16, 1, 6.0, 0.5, "mp2a"},
    {"7", "M2B", 2, 8, 6.0, 0.5, "mp2b"},
    {"7", "M3A", 8, 2, 1.0, 0.5, "mn3a"},
    {"7", "M3B", 2, 4, 1.0, 0.5, "mn3b"},

    {"8", "M1A", 4, 2, 6.0, 0.5, "mp1a"},
    {"8", "M1B", 3, 4, 6.0, 0.5, "mp1b"},
    {"8", "M1C", 2, 4, 6.0, 0.5, "mp1c"},
    {"8", "M2A", 4, 2, 1.5, 0.5, "mn2a"},
    {"8", "M2B", 3, 4, 1.5, 0.5, "mn2b"},
    {"8", "M2C", 2, 4, 1.5, 0.5, "mn2c"},
    {"8", "M3A", 16, 1, 6.0, 0.5, "xtrigger.mp3a"},
    {"8", "M3B", 8, 1, 6.0, 0.5, "xtrigger.mp3b"},
    {"8", "M3C", 2, 4, 6.0, 0.5, "xtrigger.mp3c"},
    {"8", "M3D", 2, 1, 6.0, 0.5, "mp3d"},
    {"8", "M4A", 16, 1, 1.5, 0.5, "xtrigger.mn4a"},
    {"8", "M4B", 8, 1, 1.5, 0.5, "xtrigger.mn4b"},
    {"8", "M4C", 2, 4, 1.5, 0.5, "xtrigger.mn4c"},
    {"8", "M4D", 2, 1, 1.5, 0.5, "mn4d"},
    {"8", "M5A,B", 2, 1, 6.0, 0.5, "mp5a mp5b"},
    {"8", "M6A,B", 2, 1, 1.5, 0.5, "mn6a mn6b"},
    {"8", "M7A,B", 2, 4, 6.0, 0.5, ""},
    {"8", "M8A,B", 2, 4, 1.5, 0.5, "mn8a mn8b"},

    {"9", "M1A,B", 2, 4, 6.0, 0.5, "mp1a mp1b"},
    {"9", "M2A,B", 2, 4, 6.0, 0.5, "mp2a mp2b"},
    {"9", "M3A", 16, 1, 6.0, 0.5, "xtrigger.mp3a"},
    {"9", "M3B", 2, 4, 6.0, 0.5, "xtrigger.mp3c"},
    {"9", "M3C", 8, 1, 6.0, 0.5, "xtrigger.mp3b"},
    {"9", "M4A", 16, 1, 1.5, 0.5, "xtrigger.mn4a"},
    {"9", "M4B", 2, 4, 1.5, 0.5, "xtrigger.mn4c"},
    {"9", "M4C", 8, 1, 1.5, 0.5, "xtrigger.mn4b"},
    {"9", "M5A,B", 2, 1, 6.0, 0.5, "mp5a mp5b"},
    {"9", "M6A,B", 2, 1, 1.5, 0.5, "mn6a mn6b"},

    // the bias generator of the chips; it has no replica inverter (M4C and M5B)
    {"16", "M1A-B", 2, 8, 6.0, 0.5, "mp1a mp1b"},
    {"16", "M2A-B", 2, 8, 1.5, 0.5, "mn2a mn2b"},
    {"16", "M3A,B", 2, 8, 6.0, 0.5, "mp3a mp3b"},
    {"16", "M4A-C", 2, 8, 1.5, 0.5, "mn4a mn4b"},
    {"16", "M5A,B", 2, 8, 6.0, 0.5, "mp5a"},
    // circuits/bias.cir, which has the same bias generator without a subcircuit, and the replica
    {"16 flat", "M1A-B", 2, 8, 6.0, 0.5, "m1a m1b"},
    {"16 flat", "M2A-B", 2, 8, 1.5, 0.5, "m2a m2b"},
    {"16 flat", "M3A,B", 2, 8, 6.0, 0.5, "m3a m3b"},
    {"16 flat", "M4A-C", 2, 8, 1.5, 0.5, "m4a m4b m4c"},
    {"16 flat", "M5A,B", 2, 8, 6.0, 0.5, "m5a m5b"},

    {"19 INVA", "M1", 2, 8, 6.0, 0.5, "mp1"},
    {"19 INVA", "M2", 2, 8, 1.5, 0.5, "mn2"},
    {"19 INVB", "M1A-C", 2, 8, 6.0, 0.5, "mp1a mp1b mp1c"},
    {"19 INVB", "M2A-C", 2, 8, 1.5, 0.5, "mn2a mn2b mn2c"},

    {"20", "M1A-C", 2, 8, 6.0, 0.5, "xb.mp1a xb.mp1b xb.mp1c"},
    {"20", "M2A-C", 2, 8, 1.5, 0.5, "xb.mn2a xb.mn2b xb.mn2c"},
    {"20", "M3A,C", 8, 1, 6.0, 0.5, "mp3a mp3c"},
    {"20", "M3B,D", 2, 4, 6.0, 0.5, "mp3b mp3d"},
    {"20", "M4A,C", 8, 1, 1.5, 0.5, "mn4a mn4c"},
    {"20", "M4B,D", 2, 4, 1.5, 0.5, "mn4b mn4d"},
    {"20", "M5A", 16, 1, 6.0, 0.5, "mp5a"},
    {"20", "M5B", 2, 8, 6.0, 0.5, "mp5b"},
    {"20", "M6A", 8, 2, 1.5, 0.5, "mn6a"},
    {"20", "M6B", 2, 4, 1.5, 0.5, "mn6b"},
};

/// Location of a table's devices: a circuit and a path in it.
struct TableLocation {
    const char *table, *circuit, *path;
};

inline constexpr TableLocation table_locations[] = {
    {"1", "sa1", "xtransducer."},
    {"2", "sa1", "xtransducer.xamp."},
    {"3", "sa1", "xccvs."},
    {"5", "sa1", "xhpb.xres."},
    {"5", "sa1", "xhpc.xres."},
    {"6", "sa1", ""},
    {"7", "sa1", "xsummer."},
    {"9", "sa1", "xcco."},
    {"16", "sa1", "xbias."},
    {"1", "fa1", "xtransducer."},
    {"2", "fa1", "xtransducer.xamp."},
    {"3", "fa1", "xccvs."},
    {"5", "fa1", "xhpc.xres."},
    {"8", "fa1", "xrect."},
    {"9", "fa1", "xcco."},
    {"16", "fa1", "xbias."},
    {"4", "bias_table4", "x6."},
    {"16 flat", "bias", ""},
    {"19 INVA", "inverter_biased", "xa."},
    {"19 INVB", "invb", "xb."},
    {"20", "invc", "xh."},
    {"1", "transducer", "x."},
    {"2", "transducer", "x.xamp."},
    {"2", "amplifier", "xg."},
};

/// A size that differs from the published one: the device, the parameter (m, n, or W in um), its value in circuits/, and the erratum that
/// gives the reason.
struct SizeDeviation {
    const char *table, *name, *device, *parameter;
    double built_value;
    const char* erratum;
};

inline constexpr SizeDeviation size_deviations[] = {
    {"2", "M3A-B", "mp3a mp3b", "W", 6.0, "F10a: a P pair, because the common mode is 0.1 V"},
    {"3", "M4A,B", "mn4a mn4b", "W", 1.5, "S11: N, because its current is subtracted"},
    {"5", "M6A", "mn6a", "m", 16, "S7: 1/64 like M5"},
    {"5", "M6A", "mn6a", "n", 1, "S7"},
    {"5", "M6B", "mn6b", "n", 8, "S7"},
    {"6", "M1A", "xrectc.mp1a", "m", 2, "S9a: the P array of I_C equals its N array, so that both paths have the same gain"},
    {"6", "M1A", "xrectc.mp1a", "n", 8, "S9a"},
    {"6", "M1B", "xrectc.mp1b", "m", 2, "S9a"},
    {"6", "M1B", "xrectc.mp1b", "n", 8, "S9a"},
    {"20", "M6A", "mn6a", "m", 16, "S7"},
    {"20", "M6A", "mn6a", "n", 1, "S7"},
    {"20", "M6B", "mn6b", "n", 8, "S7"},
};

/// Published devices that are missing in circuits/: their number and the reason.
struct MissingDevices {
    const char *table, *name;
    int count;
    const char* reason;
};

inline constexpr MissingDevices missing_devices[] = {
    {"2", "M4A-E", 3, "F10: a misprint of M4A-B; M4C has its own row"},
    {"2", "M5A-E", 3, "F10: a misprint of M5A-B; M5C has its own row"},
    {"4", "M5A-C", 1, "M5B: fig. 52 has no third P device besides the diode and the replica"},
    {"8", "M7A,B", 2, "S15: not used in this interpretation"},
    {"16", "M4A-C", 1, "the replica is in circuits/bias.cir only"},
    {"16", "M5A,B", 1, "the replica"},
};

}  // namespace corpuscle::circuit
