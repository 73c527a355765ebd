// Adds a copy button to each command.
for (const command of document.querySelectorAll(".command")) {
    const button = document.createElement("button");
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
        const text = command.querySelector("code").textContent;
        const copied = await navigator.clipboard.writeText(text).then(() => true, () => false);
        if (!copied) // browsers may deny the clipboard to file pages: select the text instead
            getSelection().selectAllChildren(command.querySelector("code"));
        button.textContent = copied ? "Copied" : "Selected";
    });
    command.append(button);
}
