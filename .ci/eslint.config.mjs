// For static/: modules that run in the browser, with no globals but the browser's own and Bokeh.
import js from "@eslint/js"
import globals from "globals"

export default [
    js.configs.recommended,
    {
        languageOptions: {
            ecmaVersion: 2024,
            sourceType: "module",
            globals: { ...globals.browser, Bokeh: "readonly" },
        },
        linterOptions: { reportUnusedDisableDirectives: "error" },
        rules: {
            "eqeqeq": ["error", "always", { null: "ignore" }],
            "no-implicit-globals": "error",
            "no-restricted-syntax": ["error", {
                selector: "AssignmentExpression > MemberExpression.left[object.name='window']",
                message: "Modules share through imports, not through window.",
            }],
            "no-unused-vars": ["error", { args: "after-used" }],
            "no-var": "error",
            "prefer-const": "error",
        },
    },
]
