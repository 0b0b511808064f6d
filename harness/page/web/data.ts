// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
import {Details, Film, Report} from "./types";

function textOf(id: string): string | null {
  const element = document.getElementById(id);
  return element === null ? null : element.textContent;
}

export function readReport(): Report {
  return JSON.parse(textOf("report") as string) as Report;
}

/** The inverse of packed() in packed.cpp. */
async function unpack<T>(text: string): Promise<T> {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("this browser cannot open packed data; it is older than 2023");
  }
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return JSON.parse(await new Response(stream).text()) as T;
}

export async function readDetails(run: number): Promise<Details | null> {
  const text = textOf(`details-${run}`);
  return text === null ? null : unpack<Details>(text);
}

export interface Pictures {
  film: Film;
  jpegs: string[];
}

export async function readPictures(run: number): Promise<Pictures | null> {
  const index = textOf(`film-${run}`), pictures = textOf(`pictures-${run}`);
  if (index === null || pictures === null) return null;
  return {film: await unpack<Film>(index), jpegs: JSON.parse(pictures) as string[]};
}
