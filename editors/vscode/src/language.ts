/** What the manifest says of the language, for the code: the manifest is the one place for it. */

import type * as vscode from 'vscode';

export const LANGUAGE = 'd3d8asm';

/** The endings of listings, with their dots. */
export function listingExtensions(context: vscode.ExtensionContext): string[] {
  const languages: { id: string; extensions: string[] }[] = context.extension.packageJSON.contributes.languages;
  return languages.find((language) => language.id === LANGUAGE)?.extensions ?? [];
}
