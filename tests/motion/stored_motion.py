"""What the states of a result file say by themselves: mass, momentum, energy, and how far blocks overlap. Shares nothing with the program but the file.

For covers of order 1 of lattice "block": each block's motion is x = X + u, u = c + G (X - o), whole in its 4 unknowns. Its integrals over the block are those of
its surface's triangles: volume, centroid and second moments by tetrahedra from the origin.
"""
import re
import tomllib

import h5py
import numpy as np

TRIANGLE = (np.ones((3, 3)) + np.eye(3)) / 20  # of ∫ x xᵀ dV over the tetrahedron (0, a, b, c) of volume 1, with (0, a, b, c) as rows of places




class StoredMotion:
    """A result file of block covers, with the model that made it."""

    def __init__(self, path):
        with h5py.File(path) as file:
            root = file["rockfold"]
            self.model = model_of(text_of(root["model"]))
            self.read_blocks(root["blocks"])
            states = root["states"]
            self.time = states["time"][:]
            self.displacement, self.velocity = states["displacement"][:], states["velocity"][:]
            self.hash = states["hash"][:]
            lattice = root["lattice"]
            self.origin = lattice["block_origin"][:].reshape(-1, 3)
            self.edge = np.array(lattice["edge"][:]).reshape(3, 3)
            self.functions = self.displacement.shape[1] // len(self.volume)
            self.read_contacts(root)
        self.gravity = np.array(self.model.get("gravity", [0, 0, -9.81]), float)
        material = self.model["material"]
        self.density = np.array([material[m]["density"] for m in self.block_material], float)
        young = np.array([material[m]["young_modulus"] for m in self.block_material], float)
        poisson = np.array([material[m]["poisson_ratio"] for m in self.block_material], float)
        self.shear_modulus = young / (2 * (1 + poisson))
        self.lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))

    def read_blocks(self, blocks):
        self.vertex = blocks["vertex"][:].reshape(-1, 3)
        self.vertex_begin = blocks["vertex_begin"][:]
        self.block_material = blocks["material"][:]
        face_begin, loop_begin = blocks["face_begin"][:], blocks["loop_begin"][:]
        corner_begin, corner = blocks["corner_begin"][:], blocks["corner_vertex"][:]
        self.volume, self.first, self.second, self.faces = [], [], [], []
        for b in range(len(face_begin) - 1):
            base = self.vertex[self.vertex_begin[b]]
            volume, first, second, faces = 0.0, np.zeros(3), np.zeros((3, 3)), []
            for loop in range(loop_begin[face_begin[b]], loop_begin[face_begin[b + 1]]):
                ring = corner[corner_begin[loop]:corner_begin[loop + 1]]
                faces.append(ring)
                places = self.vertex[ring] - base
                for i in range(1, len(ring) - 1):
                    t = places[[0, i, i + 1]]
                    v = np.linalg.det(t) / 6
                    volume += v
                    first += v * t.sum(0) / 4
                    second += v * (t.T @ TRIANGLE @ t)
            self.volume.append(volume)
            self.first.append(first + volume * base)
            self.second.append(second + np.outer(first, base) + np.outer(base, first) + volume * np.outer(base, base))
            self.faces.append(faces)
        self.volume, self.first, self.second = map(np.array, (self.volume, self.first, self.second))

    def read_contacts(self, root):
        self.contacts = []
        if "contacts" not in root:
            return
        stored = {name: values[:] for name, values in root["contacts"].items()}
        end = 0
        for count in root["states/contact_count"][:]:
            begin, end = end, end + count
            self.contacts.append({name: values[begin:end] for name, values in stored.items()})

    def affine(self, vectors):
        """[B] value at X = 0 and [B] gradient of a field over the blocks."""
        count = len(self.volume)
        part = vectors.reshape(self.functions, count, 3)
        if self.functions == 1:
            return part[0], np.zeros((count, 3, 3))
        to_lattice = np.linalg.inv(self.edge.T)  # ξ = inv(edges as columns) (X - o)
        gradient = np.einsum("kbi,kj->bij", part[1:4], to_lattice)
        return part[0] - np.einsum("bij,bj->bi", gradient, self.origin), gradient

    def places(self, state):
        """Of all vertices of blocks."""
        at, gradient = self.affine(self.displacement[state])
        x = self.vertex.copy()
        for b, (begin, end) in enumerate(zip(self.vertex_begin[:-1], self.vertex_begin[1:])):
            x[begin:end] += at[b] + self.vertex[begin:end] @ gradient[b].T
        return x

    def momentum(self, state):
        """[B] m v of each block, and [B] its angular momentum about the origin."""
        at, gradient = self.affine(self.displacement[state])
        v, l = self.affine(self.velocity[state])
        linear = self.density[:, None] * (self.volume[:, None] * v + np.einsum("bij,bj->bi", l, self.first))
        # ∫ (X + u) vᵀ with both affine in X: F = I + G
        f = np.eye(3) + gradient
        outer = np.einsum("bi,bj->bij", at, np.einsum("bij,bj->bi", l, self.first) + self.volume[:, None] * v) + \
            np.einsum("bij,bj,bk->bik", f, self.first, v) + np.einsum("bij,bjk,blk->bil", f, self.second, l)
        outer *= self.density[:, None, None]
        angular = np.stack([outer[:, 1, 2] - outer[:, 2, 1], outer[:, 2, 0] - outer[:, 0, 2], outer[:, 0, 1] - outer[:, 1, 0]], 1)
        return linear, angular

    def energy(self, state, law):
        """J: kinetic, strain (St. Venant and Kirchhoff), potential (zero at the start), contact (`law`: (k_n, k_s) of all joints)."""
        at, gradient = self.affine(self.displacement[state])
        v, l = self.affine(self.velocity[state])
        kinetic = 0.5 * self.density * (self.volume * (v**2).sum(1) + 2 * np.einsum("bi,bij,bj->b", v, l, self.first) +
                                        np.einsum("bij,bik,bjk->b", l, l, self.second))
        strain = 0.5 * (gradient + gradient.transpose(0, 2, 1) + gradient.transpose(0, 2, 1) @ gradient)
        stored = self.volume * (0.5 * self.lame * np.trace(strain, axis1=1, axis2=2)**2 + self.shear_modulus * (strain**2).sum((1, 2)))
        fall = self.density[:, None] * (self.volume[:, None] * at + np.einsum("bij,bj->bi", gradient, self.first))
        return {"kinetic": kinetic.sum(), "strain": stored.sum(), "potential": -float(fall.sum(0) @ self.gravity), "contact": self.contact_energy(state, law)}

    def contact_energy(self, state, law):
        if not self.contacts:
            return 0.0
        c = self.contacts[state]
        normal, shear = law
        return float((c["area"] * (c["normal_stress"]**2 / (2 * normal) + (c["shear_stress"]**2).reshape(-1, 3).sum(1) / (2 * shear))).sum())

    def same_vertices(self, other):
        """[V of the other] which vertex here is the other's, block by block: their order within a block follows from that of planes."""
        found = np.empty(len(other.vertex), int)
        for begin, end in zip(self.vertex_begin[:-1], self.vertex_begin[1:]):
            apart = np.linalg.norm(other.vertex[begin:end, None] - self.vertex[None, begin:end], axis=2)
            found[begin:end] = begin + apart.argmin(1)
        return found

    def bodies(self, state):
        """[B] (places of vertices, faces as rings of local ids) in a state."""
        x = self.places(state)
        return [(x[begin:end], [ring - begin for ring in self.faces[b]])
                for b, (begin, end) in enumerate(zip(self.vertex_begin[:-1], self.vertex_begin[1:]))]


def model_of(text):
    """The model with what the command line has overridden, which stands in comments at its end."""
    model = tomllib.loads(text)
    for path, value in re.findall(r"^#   --set (\S+?)=(.*)$", text, re.M):
        *folders, key = path.split(".")
        at = model
        for name in folders:
            at = at[int(name) - 1] if name.isdigit() else at.setdefault(name, {})
        at[key] = tomllib.loads(f"value = {value}")["value"]
    return model


def text_of(dataset):
    value = dataset[()]
    if isinstance(value, np.ndarray):
        value = value.tobytes()
    return value.decode() if isinstance(value, bytes) else value


def axes_of(body):
    x, faces = body
    normals, edges = [], set()
    for ring in faces:
        n = sum(np.cross(x[ring[i]] - x[ring[0]], x[ring[i + 1]] - x[ring[0]]) for i in range(1, len(ring) - 1))
        normals.append(n / np.linalg.norm(n))
        edges.update((min(a, b), max(a, b)) for a, b in zip(ring, np.roll(ring, -1)))
    e = np.array([x[b] - x[a] for a, b in edges])
    return np.array(normals), e / np.linalg.norm(e, axis=1)[:, None]


def overlap(one, two):
    """m, how deep two convex bodies are in each other: the least push that parts them (separating axes); 0 where they are apart."""
    if ((one[0].min(0) > two[0].max(0)) | (two[0].min(0) > one[0].max(0))).any():
        return 0.0
    n1, e1 = axes_of(one)
    n2, e2 = axes_of(two)
    crossed = np.cross(e1[:, None], e2[None]).reshape(-1, 3)
    size = np.linalg.norm(crossed, axis=1)
    crossed = crossed[size > 1e-6] / size[size > 1e-6, None]
    axes = np.concatenate([n1, n2, crossed])
    a, b = one[0] @ axes.T, two[0] @ axes.T
    depth = np.minimum(a.max(0) - b.min(0), b.max(0) - a.min(0))
    return max(0.0, float(depth.min()))
