// npm --prefix .ci/eslint ci && npm --prefix .ci/eslint run lint

import js from "@eslint/js"
import globals from "globals"

const NO_GLOBALS = {
  selector: "AssignmentExpression[left.object.name=/^(window|globalThis)$/]",
  message: "Modules import each other; nothing is left on window.",
}

export default [
  js.configs.recommended,
  {
    files: ["static/**/*.js"],
    languageOptions: { ecmaVersion: 2022, sourceType: "module", globals: { ...globals.browser, Bokeh: "readonly" } },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: {
      "no-var": "error",
      "prefer-const": "error",
      "eqeqeq": ["error", "always", { null: "ignore" }],
      "no-shadow": "error",
      "no-use-before-define": ["error", { functions: false, variables: false }],
      "object-shorthand": "error",
      "prefer-template": "error",
      "curly": ["error", "multi-line"],
      "no-restricted-syntax": ["error", NO_GLOBALS],
      // What begins with "_" belongs to a library's inside.
      "no-underscore-dangle": "error",
      "max-lines": ["error", 250],
    },
  },
  {
    // Bokeh's documented ways; what is not one stands in a single file.
    files: ["static/**/*.js"],
    ignores: ["static/pictures/bokeh_private.js"],
    rules: { "no-restricted-properties": ["error", { object: "Bokeh", property: "require" }] },
  },
]
