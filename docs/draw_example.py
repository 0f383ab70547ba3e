#!/usr/bin/env python3
"""Draws the pictures of the worked examples: docs/images/NAME.png from tests/cases/NAME.

    docs/draw_example.py                        all examples that have a picture.json
    docs/draw_example.py brick_wall cube        these
    docs/draw_example.py --rockfold PROGRAM …   another program than build/release/rockfold

It needs VTK 9 for Python (Debian, Ubuntu: apt install python3-vtk9). Without a screen run it
under xvfb-run (package xvfb). The program cuts the model; the blocks come from its exports.

picture.json beside a model says how it is drawn. All keys may be left out:

    view           [x, y, z]: from where one looks, as a direction from the middle of the picture; z is up
    zoom           1 (default): the picture is filled; larger is nearer
    centre         [x, y, z], m: the middle of the picture, with zoom; by default the middle of what is drawn
    colour         "block" (default), "stage", "volume" (dark is small), "material", "face" (where faces come from)
    palette        "rock" (default), "brick", "soil": what colours blocks and faces have
    hide           [{"stages": [0, …], "beyond": [{"point": [x, y, z], "normal": [x, y, z]}, …]}, …]: blocks of these
                   stages (without the key: of any) are left out if their centroid is beyond all of the planes
    frame          true: the edges of the box of the whole model
    explode        each block goes outwards by this share of its distance from the middle (0)
    move_stages    {"1": [dx, dy, dz], …}: blocks of a stage are moved by so many m
    glass_over     m3: larger blocks are drawn as glass
    glass_stages   [0, …]: blocks of these stages are drawn as glass
    dead_ends      true: joints that end inside blocks are drawn too
    edges          width of the edges in pixels (1); 0: none
    arguments      ["--set", …]: more arguments for the program
"""
import argparse
import colorsys
import json
import math
import random
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

import vtk

ROOT = Path(__file__).resolve().parent.parent
CASES = ROOT / "tests" / "cases"
SIZE = (1000, 750)
OVERSAMPLING = 2  # drawn so many times larger, then reduced: smooth edges

STAGE_COLOURS = [(0.80, 0.78, 0.73), (0.85, 0.33, 0.24), (0.95, 0.62, 0.20), (0.98, 0.85, 0.37), (0.45, 0.70, 0.42),
                 (0.28, 0.58, 0.78), (0.42, 0.40, 0.68), (0.70, 0.42, 0.62)]


class Block:
    """What is drawn of a block: its polygons with the numbers of their faces, and values to colour it by."""

    def __init__(self, number):
        self.number, self.polygons, self.faces, self.origins = number, [], [], []
        self.volume, self.stage, self.centroid, self.material = 0.0, 0, (0, 0, 0), 0
        self.dead_ends, self.dead_end_origins = [], []


def blocks_of(folder, program, arguments):
    """Cuts the model of a case and reads its blocks from the exports."""
    with tempfile.TemporaryDirectory() as temporary:
        surface, details = Path(temporary) / "blocks.vtp", Path(temporary) / "blocks.json"
        cut = subprocess.run([program, "cut", folder / "model.toml", "--json", "-o", Path(temporary) / "result.vtkhdf",
                              "--export", surface, "--export", details, *arguments],
                             check=True, capture_output=True, text=True)
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(surface))
        reader.Update()
        data = reader.GetOutput()
        exported = json.loads(details.read_text(encoding="utf-8"))
        reported = {block["id"]: block for block in json.loads(cut.stdout)["blocks"]}

    cells, points = data.GetCellData(), data.GetPoints()
    arrays = {name: cells.GetArray(name) for name in ("block", "face", "origin")}
    blocks = {block["id"]: Block(block["id"]) for block in exported["blocks"]}
    ids = vtk.vtkIdList()
    for cell in range(data.GetNumberOfPolys()):
        data.GetCellPoints(cell, ids)
        block = blocks[int(arrays["block"].GetTuple1(cell))]
        block.polygons.append([points.GetPoint(ids.GetId(corner)) for corner in range(ids.GetNumberOfIds())])
        block.faces.append(int(arrays["face"].GetTuple1(cell)))
        block.origins.append(int(arrays["origin"].GetTuple1(cell)))
    for entry in exported["blocks"]:
        block = blocks[entry["id"]]
        block.volume, block.stage, block.centroid = entry["volume"], entry["stage"], tuple(entry["centroid"])
        for dead_end in entry["dead_ends"]:
            block.dead_ends.append([tuple(point) for point in dead_end["points"]])
            block.dead_end_origins.append(dead_end["origin"])
        block.material = reported[entry["id"]]["material"]
    return list(blocks.values())


def beyond(planes, point):
    """Whether a point lies beyond all of the planes."""
    return all(sum(n * (x - p) for n, x, p in zip(plane["normal"], point, plane["point"])) > 0 for plane in planes)


def visible(blocks, picture):
    def hidden(block, rule):
        return block.stage in rule.get("stages", [block.stage]) and beyond(rule.get("beyond", []), block.centroid)
    return [block for block in blocks if not any(hidden(block, rule) for rule in picture.get("hide", []))]


def box_of(blocks):
    """The corners of the box of all blocks: [(least, largest)] along x, y, z."""
    corners = [point for block in blocks for polygon in block.polygons for point in polygon]
    return [(min(axis), max(axis)) for axis in zip(*corners)]


def move(blocks, picture):
    """Explodes the model, and takes stages apart."""
    middle = [(low + high) / 2 for low, high in box_of(blocks)]
    explode, stages = picture.get("explode", 0), picture.get("move_stages", {})
    for block in blocks:
        shift = [explode * (x - m) for x, m in zip(block.centroid, middle)]
        shift = [a + b for a, b in zip(shift, stages.get(str(block.stage), (0, 0, 0)))]
        for polygons in (block.polygons, block.dead_ends):
            polygons[:] = [[tuple(x + d for x, d in zip(point, shift)) for point in polygon] for polygon in polygons]


# Hues and their ranges of lightness and saturation.
PALETTES = {"rock": ((0.05, 0.09, 0.12, 0.15, 0.56, 0.60), (0.50, 0.80), (0.15, 0.40)),
            "brick": ((0.02, 0.04, 0.06), (0.48, 0.70), (0.35, 0.55)),
            "soil": ((0.06, 0.08, 0.10, 0.12), (0.35, 0.75), (0.22, 0.55))}


def palette_colour(palette, number):
    """A colour that looks drawn at random but is always the same for a number."""
    rng = random.Random(number)
    hues, lightness, saturation = PALETTES[palette]
    return colorsys.hls_to_rgb(rng.choice(hues) + rng.uniform(-0.012, 0.012), rng.uniform(*lightness),
                               rng.uniform(*saturation))


def colours(blocks, picture):
    """One colour for each polygon of each block: {block number: [(r, g, b), …]}."""
    how, palette = picture.get("colour", "block"), picture.get("palette", "rock")
    logs = [math.log(block.volume) for block in blocks]
    low, high = min(logs), max(max(logs), min(logs) + 1e-9)
    of = {}
    for block in blocks:
        if how == "stage":
            one = STAGE_COLOURS[block.stage % len(STAGE_COLOURS)]
        elif how == "material":
            one = STAGE_COLOURS[block.material % len(STAGE_COLOURS)]
        elif how == "volume":
            share = (math.log(block.volume) - low) / (high - low)
            one = colorsys.hls_to_rgb(0.62 - 0.52 * share, 0.35 + 0.40 * share, 0.55)
        else:
            one = palette_colour(palette, block.number)
        of[block.number] = [palette_colour(palette, 7 * origin + 1) if how == "face" else one
                            for origin in block.origins]
    return of


def surface_actor(blocks, of, opacity):
    points, polygons, shades = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkUnsignedCharArray()
    shades.SetNumberOfComponents(3)
    for block in blocks:
        for polygon, colour in zip(block.polygons, of[block.number]):
            polygons.InsertNextCell(len(polygon))
            for point in polygon:
                polygons.InsertCellPoint(points.InsertNextPoint(point))
            shades.InsertNextTuple3(*(round(255 * part) for part in colour))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polygons)
    data.GetCellData().SetScalars(shades)
    triangles = vtk.vtkTriangleFilter()  # VTK fills concave polygons wrongly
    triangles.SetInputData(data)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(triangles.GetOutputPort())
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    looks = actor.GetProperty()
    looks.SetInterpolationToFlat()
    looks.SetOpacity(opacity)
    looks.SetAmbient(0.36)
    looks.SetDiffuse(0.8)
    return actor


def edges_of(block):
    """Edges between different faces. Where a face with holes was split into polygons there is none."""
    around = {}
    for polygon, face in zip(block.polygons, block.faces):
        for edge in zip(polygon, polygon[1:] + polygon[:1]):
            around.setdefault(tuple(sorted(edge)), set()).add(face)
    return [edge for edge, faces in around.items() if len(faces) > 1]


def lines_actor(edges, colour, width, opacity):
    points, lines = vtk.vtkPoints(), vtk.vtkCellArray()
    for edge in edges:
        lines.InsertNextCell(2)
        for point in edge:
            lines.InsertCellPoint(points.InsertNextPoint(point))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(lines)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    looks = actor.GetProperty()
    looks.SetColor(*colour)
    looks.SetLineWidth(width * OVERSAMPLING)
    looks.SetOpacity(opacity)
    looks.LightingOff()
    return actor


def dead_ends_of(blocks):
    """Joints that end inside blocks, as a block of its own, and their rims: edges that only one convex part has."""
    joints, parts = Block(-1), {}
    for block in blocks:
        for polygon, origin in zip(block.dead_ends, block.dead_end_origins):
            joints.polygons.append(polygon)
            for edge in zip(polygon, polygon[1:] + polygon[:1]):
                key = (origin, *sorted(edge))
                parts[key] = parts.get(key, 0) + 1
    joints.faces = joints.origins = list(range(len(joints.polygons)))
    return joints, [key[1:] for key, count in parts.items() if count == 1]


def frame_edges(box):
    corners = [tuple(box[axis][(bits >> axis) & 1] for axis in range(3)) for bits in range(8)]
    return [(corners[a], corners[a | 1 << axis]) for a in range(8) for axis in range(3) if not a >> axis & 1]


def scene(blocks, frame, picture):
    glass_over, glass_stages = picture.get("glass_over", math.inf), picture.get("glass_stages", [])
    glass = [block for block in blocks if block.volume > glass_over or block.stage in glass_stages]
    solid = [block for block in blocks if block not in glass]
    of, width = colours(blocks, picture), picture.get("edges", 1)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for some, opacity, ink in ((solid, 1.0, (0.13, 0.12, 0.11)), (glass, 0.10, (0.45, 0.45, 0.45))):
        if some:
            renderer.AddActor(surface_actor(some, of, opacity))
            if width:
                edges = [edge for block in some for edge in edges_of(block)]
                renderer.AddActor(lines_actor(edges, ink, width, 1.0 if opacity == 1 else 0.5))
    joints, rims = dead_ends_of(blocks)
    if picture.get("dead_ends") and joints.polygons:
        renderer.AddActor(surface_actor([joints], {-1: [(0.80, 0.30, 0.22)] * len(joints.polygons)}, 0.75))
        renderer.AddActor(lines_actor(rims, (0.45, 0.12, 0.08), max(width, 1), 1.0))
    if picture.get("frame"):
        renderer.AddActor(lines_actor(frame_edges(frame), (0.4, 0.4, 0.4), 1, 1.0))
    return renderer


def light(renderer):
    """A sun over the left shoulder and a weaker light from the right, fixed to the camera."""
    for place, intensity in (((-0.6, 0.9, 1.0), 0.85), ((1.0, 0.1, 0.6), 0.35)):
        lamp = vtk.vtkLight()
        lamp.SetLightTypeToCameraLight()
        lamp.SetPosition(*place)
        lamp.SetFocalPoint(0, 0, 0)
        lamp.SetIntensity(intensity)
        renderer.AddLight(lamp)


def aim(renderer, points, picture):
    """Places the camera so that all points fill the picture: its middle and distance are found in a few rounds."""
    angle = math.radians(22)
    view = picture.get("view", [1.0, -1.6, 0.9])
    back = [part / math.hypot(*view) for part in view]
    flat = math.hypot(back[0], back[1])
    right = (-back[1] / flat, back[0] / flat, 0.0)
    up = (-back[2] * right[1], back[2] * right[0], back[0] * right[1] - back[1] * right[0])
    eye = [tuple(sum(p * a for p, a in zip(point, axis)) for axis in (right, up, back)) for point in points]
    middle, distance = [sum(axis) / len(axis) for axis in zip(*eye)], 0.0
    for _ in range(20):
        deepest = max(point[2] for point in eye) - middle[2]
        distance = max(distance, 1.05 * deepest)
        seen = [((x - middle[0]) / (distance - z + middle[2]), (y - middle[1]) / (distance - z + middle[2]))
                for x, y, z in eye]
        (left, farright), (low, top) = ((min(axis), max(axis)) for axis in zip(*seen))
        middle = [middle[0] + distance * (left + farright) / 2, middle[1] + distance * (low + top) / 2, middle[2]]
        needed = max((farright - left) * SIZE[1] / SIZE[0], top - low) / (2 * math.tan(angle / 2)) / 0.95
        distance *= needed
    focus = picture.get("centre") or [sum(m * axis[k] for m, axis in zip(middle, (right, up, back))) for k in range(3)]
    distance /= picture.get("zoom", 1)
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(math.degrees(angle))
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(f + distance * b for f, b in zip(focus, back)))
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCameraClippingRange()


def write_palette_png(path, image, colours_kept=256):
    """A PNG of at most 256 colours, a third of the size of a true-colour one."""
    quantized = vtk.vtkImageQuantizeRGBToIndex()
    quantized.SetInputData(image)
    quantized.SetNumberOfColors(colours_kept)
    quantized.Update()
    indices, table = quantized.GetOutput(), quantized.GetLookupTable()
    width, height, _ = indices.GetDimensions()
    scalars = indices.GetPointData().GetScalars()
    flat = bytes(int(scalars.GetValue(place)) for place in range(width * height))
    rows = b"".join(b"\0" + flat[row * width:(row + 1) * width] for row in reversed(range(height)))
    palette = b"".join(bytes(round(255 * part) for part in table.GetTableValue(index)[:3])
                       for index in range(table.GetNumberOfTableValues()))

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"PLTE", palette)
                     + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def draw(name, program, out):
    folder = CASES / name
    picture = json.loads((folder / "picture.json").read_text(encoding="utf-8"))
    blocks = blocks_of(folder, program, picture.get("arguments", []))
    frame = box_of(blocks)
    blocks = visible(blocks, picture)
    move(blocks, picture)
    renderer = scene(blocks, frame, picture)
    renderer.SetUseDepthPeeling(True)
    renderer.SetMaximumNumberOfPeels(30)
    light(renderer)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetAlphaBitPlanes(True)
    window.SetMultiSamples(0)
    window.SetSize(*(OVERSAMPLING * side for side in SIZE))
    window.AddRenderer(renderer)
    corners = {point for block in blocks for polygon in block.polygons for point in polygon}
    aim(renderer, corners | {point for edge in frame_edges(frame) for point in edge if picture.get("frame")}, picture)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    smaller = vtk.vtkImageShrink3D()
    smaller.SetInputConnection(grab.GetOutputPort())
    smaller.SetShrinkFactors(OVERSAMPLING, OVERSAMPLING, 1)
    smaller.MeanOn()
    smaller.Update()
    path = out / f"{name}.png"
    write_palette_png(path, smaller.GetOutput())
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB, {len(blocks)} blocks drawn")


def main():
    parser = argparse.ArgumentParser(description="Draws the pictures of the worked examples.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="folders of tests/cases; default: all with a picture.json")
    parser.add_argument("--rockfold", default=ROOT / "build" / "release" / "rockfold", help="the program")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images", help="folder for the pictures")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for name in options.names or sorted(path.parent.name for path in CASES.glob("*/picture.json")):
        draw(name, options.rockfold, options.out)


if __name__ == "__main__":
    main()
