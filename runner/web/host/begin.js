// The page's own script: the files of this folder one behind the other, in a scope of their own, so that several
// figures may stand on one page. It draws the scene of the <div> that it stands in.
(() => {
"use strict";
