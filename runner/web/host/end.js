new Figure(document.currentScript.parentElement).start();
})();
