"""The projects of a folder that benchmarks measure, in a random order."""
import pathlib
import random


def random_projects(folder, chance):
    """The shaders of a folder (.glsl, .frag, ShaderToy's .json), shuffled. `chance`: a random.Random or its seed."""
    files = sorted(path.resolve() for path in pathlib.Path(folder).iterdir() if path.suffix in (".glsl", ".frag", ".json"))
    (chance if isinstance(chance, random.Random) else random.Random(chance)).shuffle(files)
    return files
