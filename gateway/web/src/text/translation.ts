// SPDX-License-Identifier: Apache-2.0
/** The same texts in another language: strings, and functions where a number or name is part of the text. */
export type Translation<Table> = {
  readonly [Key in keyof Table]: Table[Key] extends (...values: infer Values) => string ? (...values: Values) => string : string;
};
