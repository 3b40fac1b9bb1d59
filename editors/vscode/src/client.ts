/** The library that speaks the language server protocol. `scripts/bundle.mjs` puts all of it into the file that this becomes. */

export { LanguageClient, State, type DocumentSelector } from 'vscode-languageclient/node';
