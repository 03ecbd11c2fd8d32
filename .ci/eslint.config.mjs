// For static/: modules that run in the browser, with no globals but the browser's own and Bokeh.
import js from "@eslint/js"
import globals from "globals"

// The folders of static/ from the ground up; none imports from one above it.
const FLOORS = ["base", "pictures", "controls", "page", "offline"]
const floors = FLOORS.slice(0, -1).map((floor, i) => ({
    files: [`static/${floor}/**`],
    rules: {
        "no-restricted-imports": ["error", {
            patterns: [{
                group: FLOORS.slice(i + 1).map((above) => `../${above}/*`),
                message: "Pass a function or tell an event: imports go down.",
            }],
        }],
    },
}))

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
    ...floors,
]
