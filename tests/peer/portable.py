"""Does `check --portable` say of strangers' texts what a browser says? Each single-pass text of a folder (files with a
mainImage, or projects as ShaderToy's API gives them) is compiled by headless Chromium behind the header that the site
writes, and judged by the program; both answers are compared.

    python3 tests/peer/portable.py FOLDER [--tidemark build/release/tidemark] [--most 300]
"""
from __future__ import annotations

import argparse
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from support.browser import Browser  # noqa: E402

UNIFORMS = ("vec3 iResolution", "float iTime", "float iChannelTime[4]", "vec4 iMouse", "vec4 iDate", "float iSampleRate",
            "vec3 iChannelResolution[4]", "int iFrame", "float iTimeDelta", "float iFrameRate")
HEADER = ("#version 300 es\nprecision highp float;\nprecision highp int;\nprecision mediump sampler3D;\n#define HW_PERFORMANCE 1\n" +
          "".join(f"uniform {each};\n" for each in UNIFORMS) +
          "".join(f"uniform sampler2D iChannel{i};\nuniform struct {{ sampler2D sampler; vec3 size; float time; int loaded; }} iCh{i};\n"
                  for i in range(4)) +
          "out vec4 shadertoy_out_color;\nvoid mainImage(out vec4 c, in vec2 f);\nvoid st_assert(bool holds, int kind) {}\n"
          "void st_assert(bool holds) {}\nvoid main() { vec4 c = vec4(0); mainImage(c, gl_FragCoord.xy); shadertoy_out_color = c; }\n")
COMPILE = """(text => {
    const gl = window.gl ??= document.createElement("canvas").getContext("webgl2");
    const shader = gl.createShader(gl.FRAGMENT_SHADER);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    return [gl.getShaderParameter(shader, gl.COMPILE_STATUS), gl.getShaderInfoLog(shader) ?? ""];
})(%s)"""
# Lines for the host, or of texts that the site cannot hold.
OF_ANOTHER_HOST = re.compile(r"^\s*#\s*(iChannel|include|version|iUniform|iKeyboard|iSize)|void\s+main\s*\(|^\s*uniform\s", re.MULTILINE)


def text_of(file: pathlib.Path) -> str | None:
    """The text of a scene of one pass; None of what is no such scene."""
    try:
        text = file.read_text("utf-8")
        if file.suffix == ".json":
            project = json.loads(text)
            passes = project.get("Shader", project)["renderpass"]
            text = passes[0]["code"] if len(passes) == 1 else ""
    except (ValueError, KeyError, TypeError, AttributeError, IndexError):
        return None
    return text if "mainImage" in text and not OF_ANOTHER_HOST.search(text) else None


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--tidemark", default="build/release/tidemark")
    parser.add_argument("--most", type=int, default=300, help="texts, drawn by lot")
    options = parser.parse_args()
    texts = {text: file for file in sorted(options.folder.rglob("*")) if file.is_file() and (text := text_of(file))}
    drawn = random.sample(sorted(texts), min(options.most, len(texts)))
    browser, refused, differ = Browser(), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for text in drawn:
            taken, words = browser.evaluate(COMPILE % json.dumps(HEADER + text))
            scene = pathlib.Path(folder) / "a.glsl"
            scene.write_text(text, "utf-8", newline="")
            ours = subprocess.run([options.tidemark, "check", "--portable", scene], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            refused += not taken
            if taken != (ours.returncode == 0):
                differ += 1
                print(f"{texts[text]}: the browser {'takes it' if taken else 'refuses it: ' + words.splitlines()[0]}; "
                      f"the program says: {(ours.stdout + ours.stderr).decode(errors='replace').strip()}")
    browser.close()
    print(f"{len(drawn)} texts, of which the browser refuses {refused}: {len(drawn) - differ} judged alike")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
