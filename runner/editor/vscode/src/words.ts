// Reads command lines. Uses nothing of the editor, so that a test can call it.

/** Splits a command as a shell would: at blanks, with '…', "…" and \; nothing is expanded. */
export function splitWords(command: string): string[] {
    const words: string[] = [];
    let word: string | undefined;
    let quote = "";
    for (let i = 0; i < command.length; ++i) {
        const c = command[i];
        if (quote === "'" ? c === "'" : quote === '"' && c === '"') {
            quote = "";
        } else if (c === "\\" && quote !== "'" && i + 1 < command.length) {
            word = (word ?? "") + command[++i];
        } else if (quote !== "") {
            word = (word ?? "") + c;
        } else if (c === "'" || c === '"') {
            quote = c;
            word ??= "";
        } else if (/\s/.test(c)) {
            if (word !== undefined)
                words.push(word);
            word = undefined;
        } else {
            word = (word ?? "") + c;
        }
    }
    if (word !== undefined)
        words.push(word);
    return words;
}

const OF_TRACE = ["--set", "--define", "--channel", "--media", "--size", "--fps", "--bpm", "--date", "--camera", "--pass", "--input",
                  "--frame", "--time", "--mouse"];
const OF_SCENE = ["--set", "--define", "--channel", "--media"];
const FLAGS = ["--allow-outside"];

/** Returns those options of a copied capture command that `kept` names, with their values. */
function optionsAmong(kept: string[], words: string[]): string[] {
    const found: string[] = [];
    for (let i = 0; i < words.length; ++i) {
        const [name] = words[i].split("=", 1);
        if (FLAGS.includes(name) || (kept.includes(name) && words[i].includes("=")))
            found.push(words[i]);
        else if (kept.includes(name) && i + 1 < words.length)
            found.push(words[i], words[++i]);
    }
    return found;
}

/** Returns the options of a moment that `capture`, `trace` and `check --trace` have in common. */
export const momentOptions = (words: string[]): string[] => optionsAmong(OF_TRACE, words);

/** Returns the options that belong to the scene at any moment. */
export const sceneOptions = (words: string[]): string[] => optionsAmong(OF_SCENE, words);

/** Returns the value of an option, or undefined. */
export function valueOf(words: string[], option: string): string | undefined {
    const at = words.indexOf(option);
    return at < 0 ? words.find((word) => word.startsWith(`${option}=`))?.slice(option.length + 1) : words[at + 1];
}

/** Returns FOLDER/STEM.ENDING, with a number after the stem if that name is taken. */
export function freeName(stem: string, ending: string, isTaken: (name: string) => boolean): string {
    for (let n = 1; ; ++n) {
        const name = n === 1 ? `${stem}${ending}` : `${stem}-${n}${ending}`;
        if (!isTaken(name))
            return name;
    }
}
