/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The part of a browser's document that charts, tables and words of the page need: elements with attributes,
 * children and texts, of a fixed size. */
"use strict";

class Text {
  constructor(text) {
    this.textContent = text;
  }
}

class Element {
  constructor(tag) {
    Object.assign(this, { tagName: tag, nodes: [], dataset: {}, style: {}, parent: null, text: "" });
    this.attributes = new Map();
    this.classList = { toggle() {} };
  }
  get children() {
    return this.nodes.filter((one) => one instanceof Element);
  }
  get firstChild() {
    return this.nodes[0];
  }
  get lastChild() {
    return this.nodes[this.nodes.length - 1];
  }
  get textContent() {
    return this.nodes.map((one) => one.textContent).join("");
  }
  set textContent(text) {
    this.nodes = text === "" ? [] : [new Text(String(text))];
  }
  getAttribute(name) {
    return this.attributes.has(name) ? this.attributes.get(name) : null;
  }
  setAttribute(name, value) {
    this.attributes.set(name, String(value));
  }
  removeAttribute(name) {
    this.attributes.delete(name);
  }
  append(...more) {
    for (const one of more) {
      if (one instanceof Element) {
        one.remove();
        one.parent = this;
      }
      this.nodes.push(one instanceof Element || one instanceof Text ? one : new Text(String(one)));
    }
  }
  remove() {
    if (this.parent) this.parent.nodes = this.parent.nodes.filter((one) => one !== this);
    this.parent = null;
  }
  replaceChildren(...others) {
    this.nodes = [];
    this.append(...others);
  }
  insertBefore(one, next) {
    one.remove();
    one.parent = this;
    const at = next ? this.nodes.indexOf(next) : this.nodes.length;
    this.nodes.splice(at, 0, one);
  }
  addEventListener() {}
  /* All elements inside with this tag, in order. */
  all(tag) {
    return this.children.flatMap((one) => [...(one.tagName === tag ? [one] : []), ...one.all(tag)]);
  }
  /* An attribute as a number. */
  number(name) {
    return Number(this.getAttribute(name));
  }
}

const byId = new Map();
/* Make a document, all of whose elements are `wide` by `high` pixels. */
function openDocument(wide, high) {
  Object.assign(Element.prototype, { clientWidth: wide, clientHeight: high });
  globalThis.document = {
    createElement: (tag) => new Element(tag),
    createElementNS: (_, tag) => new Element(tag),
    createTextNode: (text) => new Text(text),
    getElementById: (id) => {
      if (!byId.has(id)) byId.set(id, Object.assign(new Element("div"), { id }));
      return byId.get(id);
    },
    activeElement: null,
  };
  globalThis.ResizeObserver = class {
    observe() {}
  };
}

module.exports = { Element, openDocument };
