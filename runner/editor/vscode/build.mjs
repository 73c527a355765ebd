// Bundles the extension into extension.js, and writes LICENSES.txt: the licences of the packages that are in it.
import { build } from "esbuild";
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";

const { metafile } = await build({
    entryPoints: ["src/extension.ts"],
    outfile: "extension.js",
    bundle: true,
    minify: true,
    keepNames: true,
    platform: "node",
    format: "cjs",
    target: "node18",
    external: ["vscode"],
    legalComments: "none", // LICENSES.txt has the whole licences
    metafile: true,
});

const folders = new Set();
for (const { inputs } of Object.values(metafile.outputs))
    for (const file of Object.keys(inputs)) {
        const found = /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file);
        if (found)
            folders.add(found[1]);
    }

const texts = [...folders].sort().map((folder) => {
    const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
    const file = readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
    if (!license || !file || !existsSync(`${folder}/${file}`))
        throw new Error(`${name} has no licence in its package: it cannot be part of the extension`);
    return `${name} ${version} (${license})\n\n${readFileSync(`${folder}/${file}`, "utf8").trim()}\n`;
});
writeFileSync("LICENSES.txt", `extension.js contains these packages:\n\n${texts.join(`\n${"-".repeat(78)}\n\n`)}`);
