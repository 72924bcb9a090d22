"""gltf.py FILE.glb [NODE [VERTEX]] -- a reader of binary glTF 2.0 of its own: says what is wrong, or prints nodes, meshes,
animated paths and frames; with NODE its translation at each frame, with VERTEX the red of the colour there; with NODE "*" all that
it holds, as text."""
import json, math, struct, sys

data = open(sys.argv[1], "rb").read()


def want(truth, what):
    if not truth:
        sys.exit("gltf: " + what)


magic, version, length = struct.unpack_from("<4sII", data)
want(magic == b"glTF" and version == 2 and length == len(data), "header")
size, kind = struct.unpack_from("<I4s", data, 12)
want(kind == b"JSON" and size % 4 == 0, "JSON chunk")
g = json.loads(data[20:20 + size])
n, kind = struct.unpack_from("<I4s", data, 20 + size)
want(kind == b"BIN\0" and n % 4 == 0 and 28 + size + n == length == len(data), "BIN chunk")
bin = data[28 + size:]
want(g["asset"]["version"] == "2.0" and len(g["buffers"]) == 1 and g["buffers"][0]["byteLength"] == n, "buffer")
parts = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
values = []
for a in g["accessors"]:
    v = g["bufferViews"][a["bufferView"]]
    k = parts[a["type"]]
    want(a["componentType"] in (5126, 5125), "component type")
    want(v["byteOffset"] % 4 == 0 and v["byteLength"] == 4 * k * a["count"] and v["byteOffset"] + v["byteLength"] <= n, "view")
    flat = struct.unpack_from("<%d%s" % (k * a["count"], "f" if a["componentType"] == 5126 else "I"), bin, v["byteOffset"])
    want(all(math.isfinite(x) for x in flat), "numbers")
    for name, of in (("min", min), ("max", max)):
        if name in a:
            for i in range(k):
                want(abs(a[name][i] - of(flat[i::k])) <= 1e-6 * max(1, abs(a[name][i])), name)
    values.append([flat[i:i + k] for i in range(0, len(flat), k)])
for m in g["meshes"]:
    for p in m["primitives"]:
        place = g["accessors"][p["attributes"]["POSITION"]]
        want("min" in place and "max" in place, "POSITION without range")
        want(p["mode"] in (1, 4) and len(values[p["indices"]]) % (2 if p["mode"] == 1 else 3) == 0, "mode")
        want(max(values[p["indices"]])[0] < place["count"], "index")
        want(0 <= p["material"] < len(g["materials"]), "material")
        for t in p.get("targets", []):
            want(set(t) == set(p["attributes"]), "a target without its attribute")
            want(all(g["accessors"][k]["count"] == place["count"] for k in t.values()), "target")
        want(len(m.get("weights", [])) == len(p.get("targets", [])), "weights")
want(sorted(g["nodes"][0]["children"]) == list(range(1, len(g["nodes"]))), "children")
[animation] = g["animations"]
if sys.argv[2:] == ["*"]:
    for part in sorted(g):
        if part not in ("buffers", "bufferViews"):
            for x in g[part] if isinstance(g[part], list) else [g[part]]:
                print(part, json.dumps(x, sort_keys=True))
    for i, v in enumerate(values):
        for x in v:
            print(i, *("%.6g" % (y + 0) for y in x))
    sys.exit()
paths = set()
for c in animation["channels"]:
    s = animation["samplers"][c["sampler"]]
    node, path = g["nodes"][c["target"]["node"]], c["target"]["path"]
    times, out = values[s["input"]], values[s["output"]]
    want(times[0][0] == 0 and all(a < b for a, b in zip(times, times[1:])), "times")
    each = len(g["meshes"][node["mesh"]].get("weights", [])) if path == "weights" else 1
    want(len(out) == each * len(times), "values of " + path)
    if path == "rotation":
        want(all(abs(math.hypot(*q) - 1) < 1e-5 for q in out), "rotation")
    paths.add(path)
    if len(sys.argv) == 4 and node.get("name") == sys.argv[2] and path == "weights":
        [p], i = g["meshes"][node["mesh"]]["primitives"], int(sys.argv[3])
        for f in range(len(times)):
            targets = zip(p["targets"], out[f * each:(f + 1) * each])
            print(f"{values[p['attributes']['COLOR_0']][i][0] + sum(values[t['COLOR_0']][i][0] * w[0] for t, w in targets):.6f}")
    if len(sys.argv) == 3 and node.get("name") == sys.argv[2] and path == "translation":
        for x in out:
            print("%.7g\n%.7g" % x[:2])
if len(sys.argv) == 2:
    print(len(g["nodes"]) - 1, len(g["meshes"]), " ".join(sorted(paths)), len(times))
