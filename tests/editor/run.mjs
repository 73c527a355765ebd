// The extension in a real VS Code: node run.mjs VSIX TIDEMARK FOLDER, where FOLDER has VS Code in code/ and puppeteer-core. Pictures of
// each step are left in FOLDER/shots.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { testWords } from "./words_test.mjs";
import { startServer, until, valueIn, Workbench } from "./workbench.mjs";

const [vsix, tidemark, installed] = process.argv.slice(2);
const shots = join(installed, "shots");
const folder = mkdtempSync(join(tmpdir(), "tidemark-editor-"));
const workspace = join(folder, "waves");
const started = Date.now();
const say = (...words) => console.log(`${((Date.now() - started) / 1000).toFixed(1).padStart(6)} s `, ...words);

const SCENE = `#iSize 320x180
#iUniform float blue = 0.25 in { 0.0, 1.0 }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float wave = 0.5 + 0.5 * sin(9.0 * length(uv - 0.5));
    fragColor = vec4(0.1, mix(0.2, 0.85, wave), blue, 1.0);
}
`;
const FAULTY = `#iSize 320x180
float root(float x) {
    return sqrt(x);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv, root(uv.x - 0.25), 1.0);
}
`;

const BALL = `#iSize 64x36
#define STEPS 32
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 from = vec3(0.0, 0.0, -3.0), ray = normalize(vec3((2.0 * fragCoord - iResolution.xy) / iResolution.y, 2.0));
    float t = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        float d = length(from + t * ray) - 1.0;
        if (d < 0.001)
            break;
        t += d;
    }
    fragColor = vec4(vec3(t / (1.0 + t)), 1.0);
}
`;

mkdirSync(shots, { recursive: true });
mkdirSync(workspace);
for (const [name, text] of Object.entries({ ripple: SCENE, faulty: FAULTY, ball: BALL }))
    writeFileSync(join(workspace, `${name}.glsl`), text);

/** Runs the program in the workspace; fails unless it ends as expected. */
function run(words, code = 0) {
    const { status, stdout, stderr } = spawnSync(tidemark, words, { cwd: workspace, encoding: "utf8" });
    assert.equal(status, code, `tidemark ${words.join(" ")}: ${stderr}`);
    return stdout;
}

/** Returns the pixels that `capture` draws of a text. */
async function captured(text, ...options) {
    const scene = join(folder, "same.glsl"), file = join(folder, "same.png");
    writeFileSync(scene, text);
    run(["capture", scene, ...options, "-o", file]);
    return window.pixelsOf(readFileSync(file));
}

/** Returns the mean difference of two pictures' samples, 0 to 255. */
function difference(a, b) {
    assert.equal(a.length, b.length);
    return a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;
}

const k_jpeg = 3; // the preview's pictures are JPEG of quality 85

/** Waits until the preview shows what `capture` draws. */
async function awaitPicture(what, wanted) {
    let last;
    await until(`the preview shows ${what}`, async () => {
        const shown = await valueIn(await page(), "(c => [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data])(document.querySelector('canvas'))");
        last = shown?.length === wanted.length ? difference(shown, wanted) : undefined;
        return last !== undefined && last < k_jpeg;
    }).catch((error) => {
        throw new Error(`${error.message}; the mean difference is ${last}`);
    });
    return last;
}

const page = () => window.frame("the preview's page", "document.querySelector('.tidemark')?.tidemark?.number > 0");
const edited = SCENE.replace("9.0 *", "21.0 *");

const steps = {
    "an error is a problem at its line and column": async () => {
        await window.openFile("ripple.glsl");
        await window.showProblems();
        await window.typeOver(5, 18, 3, "wibble"); // 0.5
        await window.problem("wibble", "undeclared", "[Ln 5, Col 18]");
        await window.page.waitForSelector(".squiggly-error");
    },
    "its correction takes the problem away": async () => {
        await window.typeOver(5, 18, 6, "0.5");
        await until("no problem", async () => (await window.problems()).every((row) => !row.includes("undeclared")));
        await window.save();
        assert.equal(readFileSync(join(workspace, "ripple.glsl"), "utf8"), SCENE);
    },
    "the preview shows what capture draws": async () => {
        await window.command("Open Preview");
        say("  mean difference", (await awaitPicture("the scene", await captured(SCENE))).toFixed(2));
        assert.match((await page()).url(), /^http:\/\/\d+\.forwarded\.test:\d+\/#token=/); // the forwarded address
        await window.page.waitForFunction(() => / ms/.test(document.querySelector("[id*='tidemark.cost']")?.textContent));
    },
    "it follows the unsaved text": async () => {
        await window.typeOver(5, 34, 3, "21.0"); // 9.0
        say("  mean difference", (await awaitPicture("the edited text", await captured(edited))).toFixed(2));
        assert.equal(readFileSync(join(workspace, "ripple.glsl"), "utf8"), SCENE);
        await window.save();
    },
    "a knob in the preview changes the picture": async () => {
        await (await page()).evaluate(`(field => { field.value = 0.875; field.dispatchEvent(new Event("input")); })
                                       (document.querySelector("input[aria-label=blue]"))`);
        await awaitPicture("blue = 0.875", await captured(edited, "--set", "blue=0.875"));
    },
    "the traced pixel is the one that is clicked": async () => {
        await window.command("Trace a Pixel");
        await window.notification("Click the pixel");
        const frame = await page();
        await frame.waitForFunction(`document.querySelector("canvas").style.cursor === "crosshair"`);
        await (await frame.$("canvas")).click(); // in the middle
        const text = await window.notification("Pixel 160,", "of 320x180", "Image", "digits");
        say("  ", text);
        await window.page.waitForFunction(() => [...document.querySelectorAll(".view-line span[class*=ced-]")]
            .some((each) => getComputedStyle(each, "::after").content.includes("digits")));
        await window.clearNotifications();
    },
    "T traces the pixel under the pointer": async () => {
        const frame = await page();
        const canvas = await frame.$("canvas");
        const { width, height } = await canvas.boundingBox();
        await canvas.click({ offset: { x: 0.25 * width, y: 0.25 * height } }); // from the top left
        await frame.waitForFunction(`document.hasFocus() && document.activeElement === document.querySelector("canvas")`);
        await new Promise((go) => setTimeout(go, 1000)); // a page may get the focus before its keys
        await window.page.keyboard.press("t");
        say("  ", await window.notification("Pixel 80,13", "of 320x180"));
        await window.clearNotifications();
    },
    "VS Code's keys work in the preview": async () => {
        await window.page.keyboard.press("F1");
        await window.closeBox();
    },
    "a picture of it for the manual": async () => {
        const restore = await window.tidy(1440, 720);
        await window.screenshot(join(shots, "manual.png"));
        await restore();
    },
    "a still is what capture draws at that knob": async () => {
        await window.command("Capture a Still");
        const file = join(workspace, "ripple.png");
        await until("ripple.png", () => existsSync(file) && statSync(file).size > 0);
        await window.notification("Wrote ripple.png");
        assert.deepEqual(await window.pixelsOf(readFileSync(file)), await captured(edited, "--set", "blue=0.875"));
        await window.clearNotifications();
    },
    "a video by the form": async () => {
        await window.command("Capture a Video");
        const form = await window.frame("the form", "!!document.querySelector('form input[name=fps]')");
        await form.evaluate(`for (const [name, value] of [["size", "wide"], ["duration", "0.5"], ["fps", "10"]])
                                 document.querySelector("[name=" + name + "]").value = value;
                             document.querySelector("button").click()`);
        await form.waitForFunction(`document.querySelector("output").textContent.startsWith("Size: ")`);
        await form.evaluate(`document.querySelector("[name=size]").value = "64x36"; document.querySelector("button").click()`);
        await window.notification("Wrote ripple.mp4");
        const { stdout } = spawnSync("ffprobe", ["-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames", "-of",
                                                 "csv=p=0", join(workspace, "ripple.mp4")], { encoding: "utf8" });
        assert.equal(stdout.trim(), "64,36,5");
        await window.clearNotifications();
    },
    "a video that is cancelled leaves no file": async () => {
        const form = await window.frame("the form", "!!document.querySelector('form input[name=fps]')");
        await form.evaluate(`document.querySelector("[name=duration]").value = "5000"; document.querySelector("[name=size]").value = "1280x720";
                             document.querySelector("button").click()`);
        await window.notification("Capturing ripple-2.mp4", "frames"); // the progress
        await (await window.page.waitForSelector(".notifications-toasts ::-p-text(Cancel)")).click();
        await form.waitForFunction(`document.querySelector("output").textContent.startsWith("Cancelled")`);
        assert.ok(!existsSync(join(workspace, "ripple-2.mp4")));
    },
    "the status bar counts pixels that are not finite": async () => {
        await window.openFile("faulty.glsl");
        await window.command("Open Preview");
        await window.page.waitForFunction(() => /14400 pixels not finite/.test(document.querySelector("[id*='tidemark.cost']")?.textContent));
    },
    "check finds the line of a planted NaN": async () => {
        await window.openFile("faulty.glsl");
        await window.command("Check the Scene");
        await window.problem("sqrt of a negative number", "tidemark check", "times", "[Ln 3, Col 12]");
        await window.notification("Check of faulty.glsl", "finding");
        await window.clearNotifications();
    },
    "the probe of a finding leads to its description": async () => {
        await (await window.page.waitForSelector(".markers-panel a ::-p-text(times)")).click();
        await window.page.waitForFunction(() => document.querySelector(".part.editor .tab.active")?.textContent.includes("probes.txt"));
        await window.page.waitForFunction(() => /`times`/.test(document.querySelector(".editor-instance .view-lines .view-line:has(+ *)")
            ?.parentElement.textContent.replace(/\u00a0/g, " ")));
        await window.openFile("faulty.glsl");
    },
    "a measured fix is offered at its place and applied": async () => {
        await until("the offer", async () => {
            await window.goTo(3, 13);
            await window.press("Control", "."); // not heard while the editor still looks for what to offer
            const offered = await window.page.waitForFunction(
                () => document.querySelector(".action-widget")?.textContent.includes("keeps the argument of sqrt"), { timeout: 5000 })
                .catch(() => false);
            if (!offered) // it is not measured yet
                await window.press("Escape");
            return offered;
        });
        await (await window.page.waitForSelector(".action-widget ::-p-text(keeps the argument of sqrt)")).click();
        await window.page.waitForFunction(() => document.querySelector(".editor-instance .view-lines")?.textContent.includes("max(x,"));
        await until("no finding", async () => (await window.problems()).every((row) => !row.includes("sqrt of")));
        await window.save();
    },
    "the status bar has the error against double": async () => {
        const status = await window.page.waitForFunction(
            () => /, error \S+ of 255/.exec(document.querySelector("[id*='tidemark.cost']")?.textContent)?.[0]);
        say("  ", await status.jsonValue());
        const frame = await page();
        await frame.waitForFunction(`/error \\S+ of 255, worst \\S+/.test(document.querySelector(".tidemark-status").textContent)`);
    },
    "the scene as a page": async () => {
        await window.command("Export as a Page");
        await window.answerFile(join(workspace, "faulty.html"));
        await window.notification("Wrote faulty.html");
        assert.match(readFileSync(join(workspace, "faulty.html"), "utf8"), /webgl2/);
        await window.clearNotifications();
    },
    "a project as JSON becomes a folder": async () => {
        run(["export", "ball.glsl", "-o", "project.json"]);
        await window.command("Import ShaderToy JSON");
        await window.answerFile(join(workspace, "project.json"));
        await window.notification("Imported into project");
        await window.page.waitForFunction(() => document.querySelector(".part.editor .tab.active")?.textContent.includes("image.glsl"));
        assert.match(readFileSync(join(workspace, "project/image.glsl"), "utf8"), /mainImage/);
        await window.clearNotifications();
    },
    "a study shows its report": async () => {
        await window.openFile("ball.glsl");
        await window.command("Study Error and Run Time");
        await window.frame("the report", "!!document.querySelector('svg') && /STEPS/.test(document.body.textContent)");
        assert.ok(existsSync(join(workspace, "ball-study/study.json")));
    },
    "a missing program is named": async () => {
        await window.clearNotifications();
        server.setMachine({ "tidemark.path": "/nowhere/tidemark" });
        await window.notification("/nowhere/tidemark", "not found", "tidemark.path");
    },
};

let window, server, failed = 0;
try {
    testWords();
    server = await startServer({
        installed, folder, vsix,
        machine: { "tidemark.path": tidemark },
        settings: {
            "telemetry.telemetryLevel": "off",
            "security.workspace.trust.enabled": false,
            "workbench.startupEditor": "none",
            "workbench.enableExperiments": false,
            "workbench.secondarySideBar.defaultVisibility": "hidden",
            "editor.minimap.enabled": false,
            "editor.quickSuggestions": { other: "off" },
            "files.autoSave": "off", // the default of a VS Code in a browser is to save
            "extensions.autoUpdate": false,
            "extensions.autoCheckUpdates": false,
            "chat.disableAIFeatures": true,
            "git.enabled": false,
        },
    });
    window = await Workbench.open({ installed, address: server.address, workspace });
    say("VS Code is open");
    const only = process.env.STEPS ? new RegExp(process.env.STEPS) : /./;
    for (const [name, step] of Object.entries(steps)) {
        if (!only.test(name))
            continue;
        await step();
        say("ok", name);
        await window.screenshot(join(shots, `${name.replace(/\W+/g, "-")}.png`));
    }
} catch (error) {
    failed = 1;
    say("FAILED", error.stack);
    await window?.screenshot(join(shots, "failed.png")).catch(() => {});
    if (process.env.VERBOSE)
        console.log(window?.console.join("\n"));
} finally {
    await window?.close();
    await server?.stop();
    if (!process.env.KEEP)
        rmSync(folder, { recursive: true, force: true, maxRetries: 5 });
}
say(failed ? `failed; a picture of the window is in ${shots}/failed.png` : "passed");
process.exit(failed);
