float level(vec4 state) { return 0.5 + 0.5 * sin(state.x); }
