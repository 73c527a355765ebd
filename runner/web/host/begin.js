// The page's script: the files of this folder joined in one scope, so that several figures can be on one
// page. It draws the scene of the <div> that contains it.
(() => {
"use strict";
