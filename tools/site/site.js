// SPDX-License-Identifier: MIT
// The sliders of the gallery, and equations by KaTeX.
for (const pair of document.querySelectorAll(".pair")) {
  pair.querySelector("input").addEventListener("input", (event) => {
    pair.style.setProperty("--cut", event.target.value + "%");
  });
}
if (window.renderMathInElement) {
  for (const element of document.querySelectorAll(".arithmatex")) {
    renderMathInElement(element, {
      delimiters: [{left: "\\[", right: "\\]", display: true}, {left: "\\(", right: "\\)", display: false}],
      throwOnError: false,
    });
  }
}
