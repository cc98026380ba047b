"""Writes glTF 2.0: NAME.gltf (text), NAME.bin, and PNG pictures beside them. Nothing but the standard library."""
import json
import struct
import zlib


def png(path, width, height, pixel):
    """8-bit RGB; pixel(x, y) gives sRGB values 0..1, cut to that."""
    rows = bytearray()
    for y in range(height):
        row = bytearray()
        for x in range(width):
            row += bytes(int(255 * min(max(c, 0.0), 1.0) + 0.5) for c in pixel(x, y))
        rows += b"\x01" + bytes((row[i] - (row[i - 3] if i >= 3 else 0)) & 255 for i in range(len(row)))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as out:
        out.write(
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
            + chunk(b"IEND", b"")
        )


class File:
    """One scene being put together. Methods that add something return its index."""

    def __init__(self):
        self.data = bytearray()
        self.views, self.accessors, self.meshes, self.materials = [], [], [], []
        self.images, self.nodes, self.cameras, self.animations, self.roots = [], [], [], {}, []

    def accessor(self, values, kind, component, form, bounds=False):
        size = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        self.data += b"\0" * (-len(self.data) % 4)
        flat = [c for v in values for c in v] if size > 1 else list(values)
        packed = struct.pack("<%d%s" % (len(flat), form), *flat)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        entry = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(values), "type": kind}
        if bounds:
            rounded = [struct.unpack("<f", struct.pack("<f", c))[0] for c in flat]
            entry["min"] = [min(rounded[i::size]) for i in range(size)]
            entry["max"] = [max(rounded[i::size]) for i in range(size)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def texture(self, picture):
        if picture not in self.images:
            self.images.append(picture)
        return {"index": self.images.index(picture)}

    def material(self, colour=(1, 1, 1), roughness=0.8, metallic=0.0, picture=None, emission=None, glow=None):
        pbr = {"baseColorFactor": [*colour, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
        entry = {"pbrMetallicRoughness": pbr}
        if picture:
            pbr["baseColorTexture"] = self.texture(picture)
        if emission:
            strongest = max(max(emission), 1)
            entry["emissiveFactor"] = [c / strongest for c in emission]
            entry["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strongest}}
        if glow:
            entry["emissiveTexture"] = self.texture(glow)
        self.materials.append(entry)
        return len(self.materials) - 1

    def mesh(self, *parts):
        """Parts are (shape, material); see shapes.py."""
        primitives = []
        for shape, material in parts:
            points, normals, uvs, triangles = shape
            corners = [c for t in triangles for c in t]
            wide = len(points) > 65535
            primitives.append(
                {
                    "attributes": {
                        "POSITION": self.accessor(points, "VEC3", 5126, "f", True),
                        "NORMAL": self.accessor(
                            [tuple(round(32767 * c) for c in n) + (0,) for n in normals], "VEC4", 5122, "h"
                        ),
                        "TEXCOORD_0": self.accessor(uvs, "VEC2", 5126, "f"),
                    },
                    "indices": self.accessor(corners, "SCALAR", 5125 if wide else 5123, "I" if wide else "H"),
                    "material": material,
                }
            )
            # Normals are shorts with a fourth one for alignment, which the type leaves out.
            normal = primitives[-1]["attributes"]["NORMAL"]
            self.accessors[normal].update(type="VEC3", normalized=True)
            self.views[self.accessors[normal]["bufferView"]]["byteStride"] = 8
        self.meshes.append({"primitives": primitives})
        return len(self.meshes) - 1

    def node(self, name, mesh=None, at=None, turn=None, scale=None, parent=None, camera=None):
        entry = {"name": name}
        for key, value in (
            ("mesh", mesh),
            ("camera", camera),
            ("translation", at),
            ("rotation", turn),
            ("scale", scale),
        ):
            if value is not None:
                entry[key] = list(value) if isinstance(value, (tuple, list)) else value
        self.nodes.append(entry)
        index = len(self.nodes) - 1
        if parent is None:
            self.roots.append(index)
        else:
            self.nodes[parent].setdefault("children", []).append(index)
        return index

    def camera(self, name, yfov, at, turn=(0, 0, 0, 1)):
        self.cameras.append(
            {"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.001, "aspectRatio": 16 / 9}}
        )
        return self.node(name, at=at, turn=turn, camera=len(self.cameras) - 1)

    def animate(self, animation, node, path, times, values, easing="LINEAR"):
        entry = self.animations.setdefault(animation, {"name": animation, "channels": [], "samplers": []})
        kind = "VEC4" if path == "rotation" else "VEC3"
        entry["samplers"].append(
            {
                "input": self.accessor(times, "SCALAR", 5126, "f", True),
                "output": self.accessor(values, kind, 5126, "f"),
                "interpolation": easing,
            }
        )
        entry["channels"].append({"sampler": len(entry["samplers"]) - 1, "target": {"node": node, "path": path}})

    def write(self, name):
        document = {
            "asset": {"version": "2.0", "generator": "sequences/scenes/generator"},
            "scene": 0,
            "scenes": [{"nodes": self.roots}],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "cameras": self.cameras,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"uri": name + ".bin", "byteLength": len(self.data)}],
            "extensionsUsed": ["KHR_materials_emissive_strength", "KHR_mesh_quantization"],
            "extensionsRequired": ["KHR_mesh_quantization"],
        }
        if self.images:
            document["images"] = [{"uri": picture} for picture in self.images]
            document["samplers"] = [{}]
            document["textures"] = [{"source": i, "sampler": 0} for i in range(len(self.images))]
        if self.animations:
            document["animations"] = list(self.animations.values())
        with open(name + ".gltf", "w") as out:
            json.dump(document, out, separators=(",", ":"))
            out.write("\n")
        with open(name + ".bin", "wb") as out:
            out.write(self.data)
