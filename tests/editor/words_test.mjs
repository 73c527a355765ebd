// The extension's functions that need no editor.
import assert from "node:assert/strict";
import { freeName, momentOptions, sceneOptions, splitWords, valueOf } from "../../runner/editor/vscode/src/words.ts";

export function testWords() {
    assert.deepEqual(splitWords(`tidemark capture 'my scene.glsl' --set "a=1" b\\ c ''`), ["tidemark", "capture", "my scene.glsl", "--set", "a=1", "b c", ""]);
    assert.deepEqual(splitWords(`'it'\\''s'`), ["it's"]);
    const words = splitWords("capture a.glsl --time 2 --size 64x36 --set blue=1 --allow-outside --precision double --camera=1,2,3 -o a.png");
    assert.deepEqual(momentOptions(words), ["--time", "2", "--size", "64x36", "--set", "blue=1", "--allow-outside", "--camera=1,2,3"]);
    assert.deepEqual(sceneOptions(words), ["--set", "blue=1", "--allow-outside"]);
    assert.equal(valueOf(words, "--size"), "64x36");
    assert.equal(valueOf(words, "--camera"), "1,2,3");
    assert.equal(valueOf(words, "--pass"), undefined);
    const taken = ["a.png", "a-2.png"];
    assert.equal(freeName("a", ".png", (name) => taken.includes(name)), "a-3.png");
}
