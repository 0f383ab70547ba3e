"""Checks a result file as the readers of VTK and XDMF see it, with h5py alone.

usage: check_layout.py FILE.vtkhdf STATES      exit 0 = right, 77 = h5py is not here
"""
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError:
    print("h5py is not installed")
    sys.exit(77)

WIDTH_OF_TYPE = {"PolyData": 4, "UnstructuredGrid": 1}


def check_type(group, expected):
    """VTK reads `Type` only as a fixed-length ASCII string."""
    attribute = group.attrs.get_id("Type")
    kind = attribute.get_type()
    assert isinstance(kind, h5py.h5t.TypeStringID) and not kind.is_variable_str()
    assert kind.get_cset() == h5py.h5t.CSET_ASCII
    assert group.attrs["Type"] in (expected, expected.encode()), group.attrs["Type"]
    assert list(group.attrs["Version"]) == [2, 1]


def check_creation_order(group):
    """Without it, the readers find nothing."""
    order = group.id.get_create_plist().get_link_creation_order()
    assert order == h5py.h5p.CRT_ORDER_TRACKED | h5py.h5p.CRT_ORDER_INDEXED, group.name


def check_cells(group, points):
    """Offsets rise from 0 to the length of the connectivity, whose ids are points. Returns the number of cells."""
    offsets, connectivity = group["Offsets"][:], group["Connectivity"][:]
    assert offsets.dtype == connectivity.dtype
    assert group["NumberOfCells"][:].tolist() == [len(offsets) - 1]
    assert group["NumberOfConnectivityIds"][:].tolist() == [len(connectivity)]
    assert offsets[0] == 0 and offsets[-1] == len(connectivity) and (np.diff(offsets) >= 0).all()
    if len(connectivity):
        assert connectivity.min() == 0 and connectivity.max() == points - 1
    return len(offsets) - 1


def check_block(group, kind, states):
    check_type(group, kind)
    points = int(group["NumberOfPoints"][0])
    assert group["Points"].shape == (points, 3)
    if kind == "PolyData":
        cells = check_cells(group["Polygons"], points)
        assert all(check_cells(group[name], points) == 0 for name in ("Vertices", "Lines", "Strips"))
    else:
        cells = check_cells(group, points)
        assert group["Types"].dtype == np.uint8 and (group["Types"][:] == 10).all()
    check_fields(group, points, cells, states)
    if states:
        check_steps(group["Steps"], WIDTH_OF_TYPE[kind], states)
    else:
        assert "Steps" not in group
    return points, cells


def check_fields(group, points, cells, states):
    for place, rows in (("PointData", points), ("CellData", cells)):
        for name, values in group[place].items():
            of_states = states and name in group[f"Steps/{place}Offsets"]
            assert len(values) == rows * (states if of_states else 1), (values.name, values.shape)
            if of_states:
                assert group[f"Steps/{place}Offsets/{name}"][:].tolist() == [s * rows for s in range(states)]


def check_steps(steps, width, states):
    assert steps.attrs["NSteps"] == states
    assert len(steps["Values"]) == states and (np.diff(steps["Values"][:]) >= 0).all()
    assert (steps["NumberOfParts"][:] == 1).all() and len(steps["NumberOfParts"]) == states
    for name in ("PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"):
        assert not steps[name][:].any() and len(steps[name]) == states
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        assert steps[name].size == states * width


def check_vtkhdf(file, states):
    root = file["VTKHDF"]
    check_type(root, "MultiBlockDataSet")
    file["VTKHDF"].visititems(lambda _, o: check_creation_order(o) if isinstance(o, h5py.Group) else None)
    names = [name for name in root if name != "Assembly"]
    assert sorted(root["Assembly"]) == sorted(names) and "Blocks" in names
    for name in names:
        assert root["Assembly"].get(name, getlink=True).path == f"/VTKHDF/{name}"
        check_block(root[name], "UnstructuredGrid" if name == "Elements" else "PolyData", states)
    assert sorted(root[name].attrs["Index"] for name in names) == list(range(len(names)))


def check_xdmf(path, file, states):
    """Each data item names a data set of this file that has as many numbers."""
    items = xml.parse(path.with_suffix(".xdmf")).findall(".//DataItem")
    assert items
    for item in items:
        name, dataset = item.text.split(":")
        assert name == path.name
        assert file[dataset].size == np.prod([int(n) for n in item.get("Dimensions").split()]), dataset
        assert file[dataset].dtype.itemsize == int(item.get("Precision"))
    for state in range(states):
        virtual = file[f"xdmf/Blocks/displacement/{state}"]
        rows = len(virtual)
        assert virtual.is_virtual
        assert (virtual[:] == file["VTKHDF/Blocks/PointData/displacement"][state * rows : (state + 1) * rows]).all()


def check_no_dates(file):
    def check(_, item):
        if isinstance(item, h5py.Dataset):
            assert not item.id.get_create_plist().get_obj_track_times(), item.name

    file.visititems(check)


def main():
    path, states = Path(sys.argv[1]), int(sys.argv[2])
    with h5py.File(path, "r") as file:
        check_vtkhdf(file, states)
        check_xdmf(path, file, states)
        check_no_dates(file)
        assert file["rockfold"].attrs["units"]
        if states:
            assert file["rockfold/states/displacement"].shape[0] == states


if __name__ == "__main__":
    main()
