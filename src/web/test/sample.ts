// A result small enough to check by hand: a wedge (tetrahedron) that slides by (1, 0, 0) and turns, and a slab (box) that
// stays, off the middle and of uneven size.
import { Arrays, type NumberArray, type PageData } from '../data';

const wedge = [0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 1];
const slab = [3, 0, 0, 5, 0, 0, 5, 1, 0, 3, 1, 0, 3, 0, 4, 5, 0, 4, 5, 1, 4, 3, 1, 4];

export function sampleData(more: Record<string, NumberArray> = {}): PageData {
  const arrays: Record<string, NumberArray> = {
    block_id: Uint32Array.of(4, 9),
    point_count: Uint32Array.of(4, 8),
    point_xyz: Float32Array.from([...wedge, ...slab]),
    polygon_count: Uint32Array.of(4, 6),
    polygon_origin: Uint32Array.of(0, 0, 1, 2, 2, 2, 0, 0, 1, 1),
    corner_count: Uint32Array.of(3, 3, 3, 3, 4, 4, 4, 4, 4, 4),
    corner_point: Uint32Array.of(0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2,
      0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7),
    corner_edge: new Uint8Array(36).fill(1),
    volume: Float64Array.of(1, 8),
    centroid: Float64Array.of(10.5, 20.75, 30.25, 14, 20.5, 32),
    convex: Uint8Array.of(1, 1),
    finite: Uint8Array.of(1, 0),
    material: Uint32Array.of(0, 1),
    stage: Uint32Array.of(0, 2),
    class: Uint8Array.of(3, 0),
    mode: Uint8Array.of(1, 0),
    batch: Uint32Array.of(1, 0),
    factor_of_safety: Float32Array.of(NaN, NaN),
    support_force: Float32Array.of(5e3, 0),
    ...more,
  };
  return {
    document: {
      format: 1, file: 'sample.vtkhdf', title: 'Sample', command: 'run', version: '0', commit: '', origin: [10, 20, 30], blocks: 2,
      materials: ['granite', 'clay'], model: '', answer: null, arrays: [],
      origins: [{ name: 'J1', kind: 0, continues: false, material: 0 }, { name: 'rock.zmax', kind: 1, continues: false, material: -1 }, { name: 'tunnel.side', kind: 2, continues: false, material: -1 }],
    },
    arrays: new Arrays(new Map(Object.entries(arrays))),
  };
}

/// The wedge's motion in two states: none, then d = (1, 0, 0) with a turn about its middle (0.5, 0.75, 0.25); the slab stays.
export function sampleMotion(): Record<string, NumberArray> {
  const moved = [1, 0, 0, 0, -0.1, 0, 0.1, 0, 0, 0, 0, 0];
  return {
    state_time: Float64Array.of(0, 0.5),
    state_step: Float64Array.of(0, 10),
    block_middle: Float32Array.of(0.5, 0.75, 0.25, 4, 0.5, 2),
    block_motion: Float32Array.from([...new Array(24).fill(0), ...moved, ...new Array(12).fill(0)]),
  };
}
