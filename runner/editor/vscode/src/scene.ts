// Finds the scene that a document belongs to, and names and saves its files.
import * as fs from "node:fs";
import * as path from "node:path";
import * as vscode from "vscode";
import { Failure } from "./program";
import { freeName } from "./words";

export interface Scene {
    /** A file, or a folder with image.glsl. */
    path: string;
    /** The document that the user sees. */
    document: vscode.Uri;
}

const hasEntry = (text: string): boolean => /\bmain(Image|Cubemap|Sound)\s*\(|\bvoid\s+main\s*\(/.test(text);

/**
 * Returns the scene of a file, by the rule of the language server: the folder of a project, a file with an entry point, else the file
 * beside or above it that includes it.
 */
export async function sceneOf(document: vscode.TextDocument): Promise<Scene> {
    if (document.uri.scheme !== "file")
        throw new Failure("save the scene to a file first");
    const file = document.uri.fsPath;
    const folder = path.dirname(file);
    if (fs.existsSync(path.join(folder, "image.glsl")))
        return { path: folder, document: document.uri };
    if (hasEntry(document.getText()))
        return { path: file, document: document.uri };
    const including = await includerOf(file);
    if (!including)
        throw new Failure(`${path.basename(file)} has no mainImage, and no scene beside or above it includes it`);
    return { path: including, document: document.uri };
}

async function includerOf(file: string): Promise<string | undefined> {
    const root = vscode.workspace.getWorkspaceFolder(vscode.Uri.file(file))?.uri.fsPath;
    for (let folder = path.dirname(file); ; folder = path.dirname(folder)) {
        for (const name of await fs.promises.readdir(folder).catch(() => [] as string[])) {
            const candidate = path.join(folder, name);
            if (candidate === file || !/\.(glsl|frag)$/.test(name))
                continue;
            const text = await fs.promises.readFile(candidate, "utf8").catch(() => "");
            const includes = [...text.matchAll(/^[ \t]*#include[ \t]+"([^"]+)"/gm)];
            if (includes.some(([, included]) => path.resolve(folder, included) === file) && hasEntry(text))
                return name === "image.glsl" ? folder : candidate;
        }
        if (folder === root || folder === path.dirname(folder))
            return undefined;
    }
}

/** Returns the folder that commands about a scene run in, which is the one around it. */
export const folderOf = (scene: Scene): string => path.dirname(scene.path);

/** Returns the scene's name as a word of a command that runs in that folder. */
export const wordOf = (scene: Scene): string => path.basename(scene.path).replace(/^-/, "./-");

export const nameOf = (scene: Scene): string => path.basename(scene.path);

/** Returns a path beside the scene that is not taken: waves.png, waves-2.png, … */
export function outputOf(scene: Scene, ending: string): string {
    const stem = path.basename(scene.path).replace(/\.(glsl|frag)$/, "");
    const folder = path.dirname(scene.path);
    return path.join(folder, freeName(stem, ending, (name) => fs.existsSync(path.join(folder, name))));
}

/** Saves the edited GLSL files of a scene's folder, because commands read files. */
export async function saveFiles(scene: Scene): Promise<void> {
    const folder = path.dirname(scene.document.fsPath);
    for (const document of vscode.workspace.textDocuments) {
        const inFolder = document.uri.scheme === "file" && document.uri.fsPath.startsWith(folder + path.sep);
        if (document.isDirty && inFolder && document.languageId === "glsl" && !(await document.save()))
            throw new Failure(`${path.basename(document.uri.fsPath)} could not be saved`);
    }
}

/** Returns a file that a command named, relative to the folder that it ran in. */
export const fileAt = (scene: Scene, name: string): vscode.Uri => vscode.Uri.file(path.resolve(folderOf(scene), name));
