// Starts the language server, and registers the commands of package.json.
import * as vscode from "vscode";
import { LanguageClient, State, TransportKind } from "vscode-languageclient/node";
import { captureStill, captureVideo } from "./capture";
import { Findings, k_help } from "./check";
import { Measured, Pixel, Preview, Previews } from "./preview";
import { deviceOption, Failure, measureOption, MissingProgram, programPath, run, showFailure } from "./program";
import { exportPage, importProject, manual, study } from "./reports";
import { Scene, sceneOf } from "./scene";
import { Traces } from "./trace";
import { momentOptions } from "./words";

let client: LanguageClient | undefined;
let starting: Promise<void> = Promise.resolve();

export async function activate(context: vscode.ExtensionContext): Promise<void> {
    const findings = new Findings();
    const traces = new Traces();
    const trace = async (preview: Preview, pixel: Pixel): Promise<void> => {
        const moment = await preview.moment();
        if (!moment)
            throw new Failure("the preview shows no picture yet, or another viewer controls it");
        await traces.trace(preview.scene, pixel, momentOptions(moment));
    };
    const previews = new Previews(() => client, (preview, pixel) => void trace(preview, pixel).catch(showFailure));

    // The scene of the preview that has the focus, else of the active editor.
    const current = async (): Promise<Scene> => {
        const active = previews.active();
        if (active?.panel.active)
            return active.scene;
        const editor = vscode.window.activeTextEditor;
        if (editor?.document.languageId === "glsl")
            return sceneOf(editor.document);
        if (active)
            return active.scene;
        throw new Failure("open a GLSL file first");
    };
    const previewOf = (scene: Scene): Preview | undefined => {
        const preview = previews.of(scene);
        return preview?.panel.visible ? preview : undefined;
    };
    const commands: Record<string, () => Promise<unknown>> = {
        preview: async () => previews.show(await current()),
        window: async () => openWindow(await current()),
        still: async () => {
            const scene = await current();
            return captureStill(scene, previewOf(scene));
        },
        video: async () => {
            const scene = await current();
            return captureVideo(scene, previewOf(scene), context.workspaceState);
        },
        check: async () => findings.check(await current()),
        study: async () => study(await current()),
        trace: async () => pickAndTrace(previews, await current(), trace),
        exportPage: async () => exportPage(await current()),
        importProject,
    };
    for (const [name, act] of Object.entries(commands))
        context.subscriptions.push(vscode.commands.registerCommand(`tidemark.${name}`, async () => {
            try {
                await starting;
                const result = await act();
                return typeof result === "string" || typeof result === "number" ? result : undefined;
            } catch (error) {
                void showFailure(error);
                return undefined;
            }
        }));
    context.subscriptions.push(
        findings,
        traces,
        previews,
        vscode.workspace.registerTextDocumentContentProvider(k_help, manual),
        vscode.workspace.onDidChangeConfiguration((event) => {
            if (["path", "device", "measureSeconds"].some((name) => event.affectsConfiguration(`tidemark.${name}`)))
                restart(previews);
        }),
    );
    restart(previews);
    await starting;
}

export async function deactivate(): Promise<void> {
    await client?.stop().catch(() => undefined); // it may not run
}

/** Stops the language server that runs, if any, and starts one by the settings. */
function restart(previews: Previews): void {
    starting = starting.then(async () => {
        await client?.stop().catch(() => undefined);
        client = undefined;
        await run(["--version"], "/"); // gives the advice for a missing program
        client = makeClient();
        let known = false;
        client.onDidChangeState(({ newState }) => {
            if (newState === State.Running && known)
                previews.reload(); // it ended by itself and was started again
            known ||= newState === State.Running;
        });
        client.onNotification("$/tidemark/measured", (measured: Measured) => previews.note(measured));
        await client.start();
        previews.reload();
    }).catch(showFailureOnce);
}

let told = "";

/** Does not wait for an answer to the message, and does not repeat it for the same program. */
function showFailureOnce(error: unknown): void {
    const about = error instanceof MissingProgram ? programPath() : "";
    if (about === "" || about !== told)
        void showFailure(error);
    told = about;
}

const makeClient = (): LanguageClient =>
    new LanguageClient(
        "tidemark",
        "Tidemark",
        { command: programPath(), args: ["lsp", ...deviceOption(), ...measureOption()], transport: TransportKind.stdio },
        { documentSelector: [{ scheme: "file", language: "glsl" }], diagnosticCollectionName: "tidemark" },
    );

async function openWindow(scene: Scene): Promise<void> {
    const offered = client?.initializeResult?.capabilities.executeCommandProvider?.commands ?? [];
    if (!offered.includes("tidemark.openWindow"))
        throw new Failure("this tidemark opens no window for editors: install a newer one");
    await client?.sendRequest("workspace/executeCommand", { command: "tidemark.openWindow", arguments: [scene.document.toString()] });
}

/** Opens the preview if it is not open, and traces the pixel that the user clicks in it. */
async function pickAndTrace(
    previews: Previews,
    scene: Scene,
    trace: (preview: Preview, pixel: Pixel) => Promise<void>,
): Promise<void> {
    const preview = previews.of(scene) ?? previews.show(scene);
    const pixel = await vscode.window.withProgress(
        { location: vscode.ProgressLocation.Notification, title: "Click the pixel to trace in the preview", cancellable: true },
        (_progress, cancel) => preview.pick(cancel),
    );
    if (pixel)
        await trace(preview, pixel);
}
